"""Where the readings of the probes come from: simulated, recorded, or a serial line."""
