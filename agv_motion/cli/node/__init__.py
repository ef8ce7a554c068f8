"""`agv node`: the words, options and output of `ros2 node`."""
