"""What one word says of the time: a reader for each way to write it, exact in what it takes."""

from __future__ import annotations

import re
from datetime import datetime, timedelta, timezone
from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

EARLIEST, LATEST = 631_152_000.0, 4_102_444_800.0
"""[s] since 1970, of the years 1990 and 2100: no logger wrote before, and none has written after"""
DAY = 86400.0
MOST_AHEAD = 14.0 * 3600.0
"""[s] of any place on earth, before UTC"""
EXCEL_EPOCH, EXCEL_1904_EPOCH, MATLAB_EPOCH = 25569.0, 24107.0, 719529.0
"""[d] that a spreadsheet, an old one of a Macintosh, and MATLAB count up to 1970"""


USUAL = [len(word) for word in ('2013-06-10 12:30', '2013-06-10 12:30:00', '2013-06-10 12:30:00Z')]


class Instant(NamedTuple):
    """When it was, in the words of a file."""

    seconds: float
    """since 1970; as if the clock had shown UTC where the word tells no zone"""
    zoned: bool
    """whether the word tells its zone, as seconds since 1970 do"""


_CLOCK = (
    r'(?P<hour>\d{1,2})(?P<colon>:?)(?P<minute>\d{2})'
    r'(?:(?P=colon)(?P<second>\d{2}(?:[.,]\d{1,9})?))?'
    r'(?:\s*(?P<half>[AaPp])\.?[Mm]\.?)?\s*(?P<zone>Z|UTC|[+-]\d{2}(?::?\d{2})?)?'
)
_YEAR, _SHORT_YEAR = r'(?P<year>\d{4})', r'(?P<year>\d{4}|\d{2})'
_MONTHS = ['jan', 'feb', 'mar', 'apr', 'may', 'jun', 'jul', 'aug', 'sep', 'oct', 'nov', 'dec']
_NAME = r'(?P<month>[A-Za-z]{3})[a-z]*\.?'
_NUMBER = re.compile(r'\d{1,20}(?:[.,]\d*)?(?:[eE]\+?\d{1,2})?', re.ASCII)


def _dated(*dates: str) -> Callable[[str], Instant]:
    """Return a reader of dates, with a clock or without."""
    forms = [re.compile(rf'{date}(?:(?:T|[\s,]+){_CLOCK})?', re.ASCII) for date in dates]

    def read(word: str) -> Instant:
        for form in forms:
            if found := form.fullmatch(word):
                return _instant(found)
        raise ValueError

    return read


def _instant(found: re.Match[str]) -> Instant:
    """Return what a match tells; raise a ValueError where there is no such day or hour."""
    month = found['month']
    number = int(month) if month.isdecimal() else _MONTHS.index(month.lower()) + 1
    year = int(found['year'])
    year += 2000 if len(found['year']) == 2 else 0
    midnight = datetime(year, number, int(found['day']), tzinfo=timezone.utc)
    if found['hour'] is None:
        return Instant(midnight.timestamp(), zoned=False)
    seconds = _of_day(
        found['half'], int(found['hour']), int(found['minute']),
        float((found['second'] or '0').replace(',', '.')),
    )  # fmt: skip
    offset = offset_of(found['zone'])
    return Instant(midnight.timestamp() + seconds - (offset or 0.0), zoned=offset is not None)


def _of_day(half: str | None, hour: int, minute: int, second: float) -> float:
    """Return the seconds since midnight; 24:00 is the end of the day."""
    if half:
        if not 1 <= hour <= 12:
            raise ValueError(hour)
        hour = hour % 12 + (12 if half in 'pP' else 0)
    seconds = 3600.0 * hour + 60.0 * minute + second
    if minute > 59 or second >= 60.0 or seconds > DAY:
        raise ValueError(hour)
    return seconds


def offset_of(zone: str | None) -> float | None:
    """Return how far a zone such as Z or +05:30 is ahead of UTC [s]; None where there is none.

    Raises:
        ValueError: No place on earth is so far ahead or behind.

    """
    if not zone:
        return None
    if zone in {'Z', 'UTC'}:
        return 0.0
    minutes = int(zone[3:].lstrip(':') or 0)
    seconds = int(zone[1:3]) * 3600.0 + minutes * 60.0
    if minutes > 59 or seconds > MOST_AHEAD:
        raise ValueError(zone)
    return -seconds if zone[0] == '-' else seconds


def _number(word: str) -> float:
    if not _NUMBER.fullmatch(word):
        raise ValueError(word)
    number = float(word.replace(',', '.'))
    if not isfinite(number):
        raise ValueError(word)
    return number


def _epoch(unit: float) -> Callable[[str], Instant]:
    """Return a reader of a number of ``unit`` [s] since 1970."""
    return lambda word: Instant(_number(word) * unit, zoned=True)


def _serial_days(epoch: float) -> Callable[[str], Instant]:
    """Return a reader of days; seconds finer than the written digits tell are not made up."""

    def read(word: str) -> Instant:
        seconds = (_number(word) - epoch) * DAY
        decimals = len(word.replace(',', '.').partition('.')[2])
        resolution = 0.51 * DAY * 10.0**-decimals + 1e-5
        for unit in (60.0, 1.0):
            nearest = round(seconds / unit) * unit
            if decimals and abs(nearest - seconds) <= resolution:
                return Instant(nearest, zoned=False)
        return Instant(seconds, zoned=False)

    return read


def _digits(*lengths: int) -> Callable[[str], Instant]:
    """Return a reader of year, month, day, hour, minute and second without anything between."""

    def read(word: str) -> Instant:
        if not (word.isascii() and word.isdecimal() and len(word) in lengths):
            raise ValueError(word)
        midnight = datetime(int(word[:4]), int(word[4:6]), int(word[6:8]), tzinfo=timezone.utc)
        hour, minute, second = (int(word[i : i + 2] or 0) for i in (8, 10, 12))
        return Instant(midnight.timestamp() + _of_day(None, hour, minute, second), zoned=False)

    return read


def _year_day(word: str) -> Instant:
    """Read year, day of the year (whole, or with its fraction), and clock, as Campbell's arrays."""
    year, day, *clock = word.split()
    if not (word.isascii() and year.isdecimal() and len(year) == 4 and len(clock) < 2):
        raise ValueError(word)
    number = _number(day)
    begin = datetime(int(year), 1, 1, tzinfo=timezone.utc)
    whole = begin + timedelta(days=int(number) - 1)
    if whole.year != begin.year or (clock and number % 1.0):
        raise ValueError(word)
    seconds = _clock(clock[0]) if clock else round(number % 1.0 * DAY, 1)
    return Instant(whole.timestamp() + seconds, zoned=False)


def _clock(word: str) -> float:
    """Return the seconds since midnight of HHMM without its leading zeros, or of HH:MM[:SS]."""
    if word.isdecimal() and len(word) <= 4:
        return _of_day(None, *divmod(int(word), 100), 0.0)
    found = re.fullmatch(_CLOCK, word, re.ASCII)
    if not found or found['zone']:
        raise ValueError(word)
    second = float((found['second'] or '0').replace(',', '.'))
    return _of_day(found['half'], int(found['hour']), int(found['minute']), second)


def _fields(word: str) -> Instant:
    """Read year, month, day, hour, minute and second, each a column of its own."""
    year, month, day, *clock = word.split()
    if not word.isascii() or len(year) != 4 or len(clock) > 3:
        raise ValueError(word)
    if not all(map(str.isdecimal, (year, month, day))):
        raise ValueError(word)
    hour, minute, second = (_number(part) for part in (*clock, '0', '0', '0')[:3])
    if hour % 1.0 or minute % 1.0:
        raise ValueError(word)
    midnight = datetime(int(year), int(month), int(day), tzinfo=timezone.utc)
    seconds = _of_day(None, int(hour), int(minute), second)
    return Instant(midnight.timestamp() + seconds, zoned=False)


def of_pattern(pattern: str) -> Callable[[str], Instant]:
    """Return a reader of a pattern of `datetime.strptime`; 24:00 is the end of the day."""

    def read(word: str) -> Instant:
        try:
            moment, later = datetime.strptime(word, pattern), 0.0  # noqa: DTZ007 - may be without
        except ValueError:
            begun = re.sub(r'\b24(?=:?00)', '00', word)
            moment, later = datetime.strptime(begun, pattern), DAY  # noqa: DTZ007
            if moment.hour or moment.minute or moment.second:
                raise
        utc = moment if moment.tzinfo else moment.replace(tzinfo=timezone.utc)
        return Instant(utc.timestamp() + later, zoned=moment.tzinfo is not None)

    return read


_SEPARATED = r'(?P<to>[-/.])'
_ISO = (
    rf'{_YEAR}{_SEPARATED}(?P<month>\d{{1,2}})(?P=to)(?P<day>\d{{1,2}})',
    rf'{_YEAR}(?P<month>\d{{2}})(?P<day>\d{{2}})(?=T)',
)


def _by_parts(year: str, first: str, second: str, separators: str) -> str:
    return rf'(?P<{first}>\d{{1,2}})(?P<to>[{separators}])(?P<{second}>\d{{1,2}})(?P=to){year}'


_iso = _dated(*_ISO)


def _plain(word: str) -> Instant:
    """Read ISO 8601, or seconds since 1970: what means one time only."""
    if len(word) in USUAL and word[4] == '-':
        zoned = word[-1] == 'Z'
        try:  # the usual word the quick way
            moment = datetime.fromisoformat(word[:-1] if zoned else word)
        except ValueError:
            return _iso(word)
        if moment.tzinfo is None:
            return Instant(moment.replace(tzinfo=timezone.utc).timestamp(), zoned)
    return _epoch(1.0)(word) if _NUMBER.fullmatch(word) else _iso(word)


FORMATS: dict[str, Callable[[str], Instant]] = {
    'iso': _iso,
    'day_first': _dated(_by_parts(_SHORT_YEAR, 'day', 'month', '-/.')),
    'month_first': _dated(_by_parts(_SHORT_YEAR, 'month', 'day', '-/.')),
    'named_month': _dated(
        rf'(?P<day>\d{{1,2}})[-/. ]{_NAME}[-/., ]+{_SHORT_YEAR}',
        rf'{_NAME} +(?P<day>\d{{1,2}}),? +{_YEAR}',
    ),
    'YYYYMMDD': _digits(8),
    'YYYYMMDDHHMM': _digits(12),
    'YYYYMMDDHHMMSS': _digits(14),
    'epoch_s': _epoch(1.0),
    'epoch_ms': _epoch(1e-3),
    'epoch_us': _epoch(1e-6),
    'epoch_ns': _epoch(1e-9),
    'excel': _serial_days(EXCEL_EPOCH),
    'excel_1904': _serial_days(EXCEL_1904_EPOCH),
    'matlab': _serial_days(MATLAB_EPOCH),
    'year_day': _year_day,
    'fields': _fields,
}
"""The ways to write a time that have a name."""

UNASKED: dict[str, Callable[[str], Instant]] = {
    'iso': _plain,
    'day_first': _dated(_by_parts(_YEAR, 'day', 'month', '-/.')),
    'month_first': _dated(_by_parts(_YEAR, 'month', 'day', '-/')),
    'named_month': FORMATS['named_month'],
}
"""Those that are looked for where nobody has named one: no number but seconds since 1970."""

OF_COLUMNS: dict[str, Callable[[str], Instant]] = {'year_day': _year_day, 'fields': _fields}
"""Those that are looked for beside, where several columns make the time."""


def in_range(instant: Instant) -> bool:
    """Tell whether a time lies in the years that loggers have written of."""
    return EARLIEST <= instant.seconds < LATEST
