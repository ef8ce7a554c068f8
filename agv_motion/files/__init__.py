"""Files that people and other programs write: one door, limits, errors with line and column.

`text` reads any of them, `yaml_text` and `json_text` give a tree of `Marked` values.
"""
