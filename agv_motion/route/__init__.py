"""Routes through waypoints, followed by a virtual point."""
