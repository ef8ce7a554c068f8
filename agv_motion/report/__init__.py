"""Figures and analyses of runs, read back from their bags; matplotlib lives here only."""
