"""`agv service`: the words, options and output of `ros2 service`."""
