"""`agv interface`: the words, options and output of `ros2 interface`."""
