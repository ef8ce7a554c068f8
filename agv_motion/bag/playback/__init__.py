"""Play a bag: each message at its time."""
