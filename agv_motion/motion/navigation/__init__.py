"""Where the tree may go, and by which path."""
