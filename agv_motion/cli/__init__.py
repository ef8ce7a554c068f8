"""The `agv` command."""
