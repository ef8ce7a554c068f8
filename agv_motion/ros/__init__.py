"""What several nodes need from rclpy; nothing here knows physics."""
