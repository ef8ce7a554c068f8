"""The black box of a recorder: what happened, some time before and after it, as a bag each."""
