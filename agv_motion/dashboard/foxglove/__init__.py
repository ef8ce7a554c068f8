"""What tools such as Foxglove and Lichtblick are told and ask: no socket, no ROS, no clock."""
