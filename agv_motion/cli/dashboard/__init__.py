"""`agv dashboard`."""
