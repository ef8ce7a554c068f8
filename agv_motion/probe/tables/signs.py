"""The signs of a table, by the words that name them: between cells, and of decimals."""

import re

DELIMITERS = {'comma': ',', 'semicolon': ';', 'tab': '\t', 'pipe': '|', 'blanks': ' '}
DECIMALS = {'point': '.', 'comma': ','}
JOIN = '+'
"""between the names of columns that make one time"""
NUMBER = re.compile(r'[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d{1,3})?', re.ASCII)
"""with a point, in one way only: of a million digits none is looked at twice"""
