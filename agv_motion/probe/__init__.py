"""SENSE: Granier probes, from the raw voltage to a sap flow in [0, 1]."""
