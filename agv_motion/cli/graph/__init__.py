"""Join the ROS graph for a moment, as the commands that look at it do."""
