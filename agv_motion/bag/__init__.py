"""Bags in MCAP: write, read, inspect; without rclpy."""
