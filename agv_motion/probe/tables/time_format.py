"""In which format a column of times is written: the one that reads it, if there is just one.

A number that means another time in another format (20130610, 41435.5 days of a spreadsheet,
milliseconds) is never guessed into one, and neither is 10/06/2013: the error names the formats.
"""

from __future__ import annotations

import re
from datetime import datetime, timezone
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.probe.tables.time_readers import (
    FORMATS,
    OF_COLUMNS,
    UNASKED,
    Instant,
    in_range,
    of_pattern,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

REMEDY = 'give ISO 8601 such as 2013-06-10T00:00:00Z, or name the format by csv.time_format'
LOOKED_AT = 400
"""Rows, spread over the file, by which formats are found; all rows are read by what is found."""
MAJORITY = 10
"""A format that reads this many times as many rows as another reads alone is the right one."""

_YEAR, _TENS = r'(?:199\d|20\d\d)', r'\d\d'
_MONTH, _DAY = r'(?:0[1-9]|1[0-2])', r'(?:0[1-9]|[12]\d|3[01])'
_HOUR, _MINUTE = r'(?:[01]\d|2[0-3])', r'[0-5]\d'
_TEN_DIGITS = {
    name: re.compile(''.join(parts), re.ASCII)
    for name, parts in {
        '%Y%m%d%H': (_YEAR, _MONTH, _DAY, _HOUR),
        '%y%m%d%H%M': (_TENS, _MONTH, _DAY, _HOUR, _MINUTE),
        '%d%m%Y%H': (_DAY, _MONTH, _YEAR, _HOUR),
        '%m%d%Y%H': (_MONTH, _DAY, _YEAR, _HOUR),
        '%d%m%y%H%M': (_DAY, _MONTH, _TENS, _HOUR, _MINUTE),
        '%m%d%y%H%M': (_MONTH, _DAY, _TENS, _HOUR, _MINUTE),
    }.items()
}
"""Ten digits of a date, which are as many as seconds since 1970 have."""


class TimeFormat(NamedTuple):
    """How the times of a file are written."""

    name: str
    """as `csv.time_format` calls it"""
    read: Callable[[str], Instant]
    """raises a ValueError where a word is no such time"""

    def instant(self, word: str) -> Instant:
        """Return what a word tells.

        Raises:
            SourceError: It is no time of this format, or lies outside 1990 to 2100.

        """
        try:
            instant = self.read(word)
        except (ValueError, OverflowError):
            raise _no_time(word, f'no time: {self._remedy(word)}') from None
        if not in_range(instant):
            raise _no_time(word, f'no time from 1990 to 2100: {self._remedy(word)}')
        return instant

    def _remedy(self, word: str) -> str:
        others = [f'{name} reads {iso(read)}' for name, read in readings(word).items()]
        if others:
            return f'csv.time_format: {" or ".join(others)}'
        return REMEDY if self.name == 'iso' else f'as csv.time_format {self.name}'


PLAIN = TimeFormat('iso', UNASKED['iso'])
"""ISO 8601, or seconds since 1970."""


def named(name: str) -> TimeFormat:
    """Return a format by its name, or of a pattern such as ``%d.%m.%Y %H:%M``.

    Raises:
        ConfigurationError: There is none of that name.

    """
    if '%' in name:
        return TimeFormat(name, of_pattern(name))
    if name not in FORMATS:
        msg = (
            f"time_format = '{name}': choose auto, {', '.join(FORMATS)}, "
            'or a pattern such as %d.%m.%Y %H:%M'
        )
        raise ConfigurationError(msg)
    return TimeFormat(name, FORMATS[name])


def readings(word: str) -> dict[str, float]:
    """Return the formats that read a word as a time from 1990 to 2100, with that time [s]."""
    found: dict[str, float] = {}
    for name, read in FORMATS.items():
        try:
            instant = read(word)
        except (ValueError, OverflowError):
            continue
        if in_range(instant) and instant.seconds not in found.values():
            found[name] = instant.seconds
    return found


def choose(words: Sequence[str], *, joined: bool) -> TimeFormat:
    """Return the format that reads a column of times.

    Args:
        words: Of the rows, as they are written.
        joined: Whether each is made of several columns.

    Raises:
        SourceError: Two formats read it, and tell other times.

    """
    candidates = UNASKED | OF_COLUMNS if joined else UNASKED
    for looked_at in (words[:: max(1, len(words) // LOOKED_AT)], words):
        read = {name: _read(looked_at, reader) for name, reader in candidates.items()}
        best = max(read, key=lambda name: len(read[name]))
        doubt = next(filter(None, (_doubt(read, best, name) for name in read)), '')
        if not doubt:
            return TimeFormat(best, candidates[best])
    raise SourceError(doubt)


def _doubt(read: Mapping[str, Mapping[str, float]], best: str, other: str) -> str:
    """Return what the other format makes of the times as well; empty where the best is right."""
    these, those = read[best], read[other]
    conflict = next((word for word, time in those.items() if these.get(word, time) != time), None)
    if conflict is None or _alone(these, those) > MAJORITY * _alone(those, these):
        return ''
    return (
        f'{conflict[:80]!r} may be {iso(these[conflict])} ({best}) or {iso(those[conflict])} '
        f'({other}): choose by csv.time_format'
    )


def _read(words: Sequence[str], reader: Callable[[str], Instant]) -> dict[str, float]:
    """Return the words that are times, and which."""
    found = {}
    for word in words:
        try:
            instant = reader(word)
        except (ValueError, OverflowError):
            continue
        if in_range(instant):
            found[word] = instant.seconds
    return found


def _alone(these: Mapping[str, float], those: Mapping[str, float]) -> int:
    """Return how many words the one format reads and the other does not."""
    return sum(word not in those for word in these)


def second_reading(words: Sequence[str]) -> str:
    """Return in what other way the numbers of a file can be read, empty where there is none."""
    for name, form in _TEN_DIGITS.items():
        if all(form.fullmatch(word) for word in words):
            return f'seconds since 1970 or {name}: choose by csv.time_format'
    return ''


def without_clock(words: Sequence[str], times: Sequence[float]) -> str:
    """Return what is missing where all times are days alone, and some have several rows."""
    days = all(time % 86400.0 == 0.0 for time in times) and not any(':' in word for word in words)
    if days and len(set(times)) < len(times):
        return (
            'days alone, some with several rows: name the column of the clock too, '
            "as csv.time_column: 'date + clock'"
        )
    return ''


def parse_time(words: str) -> float:
    """Return the time of a start, ISO 8601 or a number of seconds, in seconds since 1970.

    Args:
        words: The time; UTC where it tells no zone.

    Raises:
        SourceError: It is neither, or lies outside 1990 to 2100.

    """
    try:
        return PLAIN.instant(words.strip()).seconds
    except SourceError as error:
        unquoted = error.unquoted
        told = SourceError(f'start: {error}')
        told.unquoted = unquoted
        raise told from None


def _no_time(word: str, reason: str) -> SourceError:
    error = SourceError(f'{word[:80]!r} is {reason}')
    error.unquoted = reason
    return error


def iso(time: float) -> str:
    """Return seconds since 1970 as ISO 8601."""
    return datetime.fromtimestamp(time, timezone.utc).isoformat()
