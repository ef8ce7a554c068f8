"""Trajectories in time: speed profiles, curves, the Ghost, and laws that follow it."""
