"""What the page knows, from messages: no server and no ROS."""
