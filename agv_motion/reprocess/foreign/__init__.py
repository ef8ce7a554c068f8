"""Anybody's node of rclpy over a recording: without middleware, the same to the bit, or refused."""
