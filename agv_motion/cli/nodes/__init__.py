"""`agv nodes`, `agv run` and `agv parameters`: the nodes of this package."""
