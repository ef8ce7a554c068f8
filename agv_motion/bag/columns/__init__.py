"""Topics of a bag as numpy columns."""
