"""What to do now: goals, memory, hours, home and rest of one tree."""
