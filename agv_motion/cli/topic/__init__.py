"""`agv topic`: the words, options and output of `ros2 topic`."""
