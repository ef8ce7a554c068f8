"""Rigs of the long runs: what tries the package for days of simulated time."""
