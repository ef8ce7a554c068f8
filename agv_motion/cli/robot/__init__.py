"""Commands that move a robot or say how it would move, and that measure it."""
