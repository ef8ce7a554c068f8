"""What the bytes of a message mean: definitions, layout in CDR, messages as objects and rows."""
