"""The signs of a table, by the words that name them: between cells, and of decimals."""

DELIMITERS = {'comma': ',', 'semicolon': ';', 'tab': '\t', 'pipe': '|', 'blanks': ' '}
DECIMALS = {'point': '.', 'comma': ','}
JOIN = '+'
"""between the names of columns that make one time"""
