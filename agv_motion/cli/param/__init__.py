"""`agv param`: the words, options and output of `ros2 param`."""
