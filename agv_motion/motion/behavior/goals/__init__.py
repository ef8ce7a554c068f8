"""Where a tree goes next: the strategies, one a file, and the table of their names."""
