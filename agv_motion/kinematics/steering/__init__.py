"""Steering of a platform on turrets: one centre of rotation at all times, and every limit held."""
