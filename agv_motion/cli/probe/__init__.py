"""`agv probes`: parsing and printing of what looks into the files of loggers."""
