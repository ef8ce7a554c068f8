"""`agv lifecycle`: the words, options and output of `ros2 lifecycle`."""
