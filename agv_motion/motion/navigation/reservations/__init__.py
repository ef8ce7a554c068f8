"""Several trees in one zone: who may stand and go where, so that they never touch or block."""
