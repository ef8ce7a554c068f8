"""The demos: whole robots on one executor, from their configuration to a bag."""
