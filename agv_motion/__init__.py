"""Motion of slow, sensor-driven robots: a plain Python core, and the ROS 2 nodes that carry it."""
