"""Sequences of actions: read, predicted, performed."""
