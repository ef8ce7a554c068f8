"""The time of a recorded row: ISO 8601, or seconds since 1970; no other number is a time.

Loggers and spreadsheets also write times as numbers of other meaning (20130610, 41435.5 days,
milliseconds). Taken for seconds they would tell another century, so what is not between 1990 and
2100 is refused, and so is a column of numbers that read as dates as well.
"""

from __future__ import annotations

import re
from datetime import datetime, timezone
from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterable

EARLIEST, LATEST = 631_152_000.0, 4_102_444_800.0
"""[s] since 1970, of the years 1990 and 2100"""
REMEDY = 'give ISO 8601 such as 2013-06-10T00:00:00Z'
_SECONDS = (
    'a number is taken for seconds since 1970, never for days of a spreadsheet, milliseconds '
    f'or digits of a date; {REMEDY}'
)

_YEAR, _TENS = r'(?:199\d|20\d\d)', r'\d\d'
_MONTH, _DAY = r'(?:0[1-9]|1[0-2])', r'(?:0[1-9]|[12]\d|3[01])'
_HOUR, _MINUTE = r'(?:[01]\d|2[0-3])', r'[0-5]\d'
_DATES = {
    name: re.compile(''.join(parts), re.ASCII)
    for name, parts in {
        'YYYYMMDDHH': (_YEAR, _MONTH, _DAY, _HOUR),
        'YYMMDDHHMM': (_TENS, _MONTH, _DAY, _HOUR, _MINUTE),
        'DDMMYYYYHH': (_DAY, _MONTH, _YEAR, _HOUR),
        'MMDDYYYYHH': (_MONTH, _DAY, _YEAR, _HOUR),
        'DDMMYYHHMM': (_DAY, _MONTH, _TENS, _HOUR, _MINUTE),
        'MMDDYYHHMM': (_MONTH, _DAY, _TENS, _HOUR, _MINUTE),
    }.items()
}
"""Ten digits of a date, which are as many as seconds since 1970 have."""
_DAY_ALONE = re.compile(r'\d{4}-\d\d-\d\d', re.ASCII)


def parse_time(words: str, place: str = 'start') -> float:
    """Return an ISO 8601 time, or a number of seconds, in seconds since 1970.

    Args:
        words: The time; UTC where it tells no zone.
        place: What it is, for the error.

    Raises:
        SourceError: It is neither, or lies outside 1990 to 2100.

    """
    word = words.strip()
    number = word.replace('.', '', 1).isdecimal()
    try:
        if number:
            time = float(word)
        else:
            moment = datetime.fromisoformat(word.replace('Z', '+00:00'))
            time = moment.replace(tzinfo=moment.tzinfo or timezone.utc).timestamp()
    except (ValueError, OverflowError):
        raise _no_time(word, place, f'no time: {REMEDY}') from None
    if not EARLIEST <= time < LATEST:
        when = f' ({iso(time)})' if number and time < EARLIEST else ''
        wrong = f'no time from 1990 to 2100{when}: {_SECONDS if number else REMEDY}'
        raise _no_time(word, place, wrong)
    return time


def _no_time(word: str, place: str, reason: str) -> SourceError:
    error = SourceError(f'{place}: {word[:80]!r} is {reason}')
    error.unquoted = reason
    return error


def second_reading(words: Iterable[str]) -> str:
    """Return in what other way all times of a file can be read, empty where there is none."""
    forms, days, count = _DATES, set[str](), 0
    alone = True
    for count, word in enumerate(words, 1):  # noqa: B007 - its last value is wanted
        forms = {name: form for name, form in forms.items() if form.fullmatch(word)}
        alone = alone and _DAY_ALONE.fullmatch(word) is not None
        if not forms and not alone:
            return ''
        days.add(word)
    if forms:
        return f'seconds since 1970 or {next(iter(forms))}: {REMEDY}'
    if len(days) < count:
        return f'days alone, some with several rows: join date and clock in one column, {REMEDY}'
    return ''


def iso(time: float) -> str:
    """Return seconds since 1970 as ISO 8601."""
    return datetime.fromtimestamp(time, timezone.utc).isoformat()
