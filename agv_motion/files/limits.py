"""What a file of keys and values may hold: bounds far above what anyone writes by hand."""

DEPTH = 64
"""Mappings and lists within each other."""
VALUES = 50_000
"""Values in all, those that an alias repeats counted again."""
NUMBER = 100
"""Characters of a number; the longest that means anything has 26."""
