"""Record a graph into a bag: splitting, deleting, and what was lost."""
