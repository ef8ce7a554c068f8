"""DECIDE: where the tree wants to be, and the twist that takes it there."""
