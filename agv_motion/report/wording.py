"""Findings in words, as titles have them."""

from __future__ import annotations

NUMBERS = (
    'no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten', 'eleven',
    'twelve', 'thirteen', 'fourteen', 'fifteen', 'sixteen', 'seventeen', 'eighteen', 'nineteen',
    'twenty',
)  # fmt: skip


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
    return f'{in_words(seconds / 3600.0)} hours'


def sentence(text: str) -> str:
    """Return a finding with a capital at its beginning; nothing else is changed."""
    return text[:1].upper() + text[1:]
