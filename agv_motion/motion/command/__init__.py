"""The command of the tree, its limits, and the twist it means."""
