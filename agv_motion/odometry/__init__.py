"""KNOW: where the robot is, from its wheels and from position fixes."""
