"""`agv bag`: parsing and printing of what looks into bags."""
