"""Findings in words, as titles have them."""

from __future__ import annotations

NUMBERS = (
    'no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten', 'eleven',
    'twelve', 'thirteen', 'fourteen', 'fifteen', 'sixteen', 'seventeen', 'eighteen', 'nineteen',
    'twenty',
)  # fmt: skip
LONGEST_NOTE = 40
"""characters of a note that are drawn"""


def in_words(number: float) -> str:
    """Return a whole number as a word up to twenty, and in digits above."""
    whole = round(number)
    return NUMBERS[whole] if 0 <= whole < len(NUMBERS) else f'{whole}'


def span_in_words(seconds: float) -> str:
    """Return a length of time as people say it: "an hour", "twelve minutes"."""
    if seconds < 90.0:
        return f'{seconds:.0f} seconds'
    if abs(seconds - 3600.0) < 60.0:
        return 'an hour'
    if seconds < 2.0 * 3600.0:
        return f'{in_words(seconds / 60.0)} minutes'
    if seconds < 2.0 * 86400.0:
        return f'{in_words(seconds / 3600.0)} hours'
    return f'{in_words(seconds / 86400.0)} days'


def counted(number: float, name: str) -> str:
    """Return a number of things, "one action", "seven actions"."""
    return f'{in_words(number)} {name}{"" if round(number) == 1 else "s"}'


def length(metres: float) -> str:
    """Return a length in the unit that fits: "3 mm", "40 cm", "15.0 m"."""
    if metres < 0.01:
        return f'{1e3 * metres:.0f} mm'
    return f'{100.0 * metres:.0f} cm' if metres < 1.0 else f'{metres:.1f} m'


def clipped(text: str, most: int) -> str:
    """Return a text of ``most`` characters at most; one that is longer ends with an ellipsis."""
    return text if len(text) <= most else f'{text[: most - 1].rstrip()}…'


def sentence(text: str) -> str:
    """Return a finding with a capital at its beginning; nothing else is changed."""
    return text[:1].upper() + text[1:]
