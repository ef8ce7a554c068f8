"""The lines of loggers that do not begin with a plain time: by the name of a format, or a pattern.

A line tells a time and the values of the probes. Where it tells no time, or no year, the moment at
which it arrives does.
"""

from __future__ import annotations

import re
from datetime import datetime, timezone
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.probe.sources.logger_line import (
    EPOCHS,
    YEARS,
    LoggerLine,
    number_of,
    read_line,
    words_of,
)
from agv_motion.probe.tables.time_format import named
from agv_motion.probe.tables.time_readers import FORMATS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from agv_motion.probe.tables.time_format import TimeFormat

COMMA = 'array,year,day of the year,HHMM,v1,v2,...'
PRINTABLE = '01+0110. 02+0161. 03+1230. 04+v1 05+v2 ...'
DATATAKER = 'D,serial,"job",YYYY/MM/DD,HH:MM:SS,fraction,n;A,0,v1,v2,...;length;CRC'
_LABEL = re.compile(r'[A-Za-z_]\w{0,40}\s{0,9}[:=]\s*')  # bounded: long words cost no square
_PRINTABLE = re.compile(r'(\d{2})([+-]\d*\.?\d*)')


class Arrival(NamedTuple):
    """What is known of a line beside its words."""

    now: float
    """[s since 1970] when it arrived"""
    utc_offset: float
    """[h] time of the logger minus UTC"""


def _arrival(text: str, arrival: Arrival) -> LoggerLine:
    """Read numbers alone, each with a label before it or not; the time is that of the arrival."""
    words, decimal_comma = words_of(_LABEL.sub(' ', text))
    return LoggerLine(arrival.now, tuple(map(number_of, words)), decimal_comma)


def _campbell_comma(text: str, arrival: Arrival) -> LoggerLine:
    """Read the array of a Campbell logger with commas: its number, year, day, HHMM, values."""
    cells = [cell.strip() for cell in text.split(',')]
    if len(cells) < 4:
        raise _unlike(COMMA)
    time = _in_year(cells[1], cells[2], cells[3], arrival)
    return LoggerLine(time, tuple(map(number_of, cells[4:])), decimal_comma=False)


def _campbell_printable(text: str, arrival: Arrival) -> LoggerLine:
    """Read the printable array of a Campbell logger: 01+0110. 02+0161. 03+1230. 04+0.41 ...

    The first three are the number of the array, day of the year and HHMM; or the first four with
    the year in second place.
    """
    found = _PRINTABLE.findall(text)
    if len(found) < 3 or [int(place) for place, _ in found] != list(range(1, len(found) + 1)):
        raise _unlike(PRINTABLE)
    words = [value.rstrip('.') for _, value in found]
    dated = number_of(words[1]) > 366.0 and len(words) > 3
    parts = 4 if dated else 3
    year, day, clock = ['', *(word.lstrip('+').lstrip('0') or '0' for word in words[1:parts])][-3:]
    time = _in_year(year, day, clock, arrival)
    return LoggerLine(time, tuple(map(number_of, words[parts:])), decimal_comma=False)


def _datataker(text: str, arrival: Arrival) -> LoggerLine:
    """Read the fixed form of a dataTaker: head; letter of the schedule, 0, values; length; CRC."""
    head, _, rest = text.partition(';')
    cells, told = head.split(','), rest.partition(';')[0].split(',')
    if len(cells) < 6 or cells[0] != 'D' or len(told) < 3 or not told[0].isalpha():
        raise _unlike(DATATAKER)
    fraction = number_of(cells[5])
    if not 0.0 <= fraction < 1.0:
        msg = f"'{cells[5]:.40}' is no fraction of a second"
        raise SignalError(msg)
    time = instant_of(f'{cells[3]} {cells[4]}', named('iso'), arrival) + fraction
    return LoggerLine(time, tuple(map(number_of, told[2:])), decimal_comma=False)


def _plain(text: str, arrival: Arrival) -> LoggerLine:
    return read_line(text, arrival.utc_offset)


LINE_FORMATS: dict[str, Callable[[str, Arrival], LoggerLine]] = {
    'auto': _plain,
    'arrival': _arrival,
    'campbell_comma': _campbell_comma,
    'campbell_printable': _campbell_printable,
    'datataker': _datataker,
}
"""Those that have a name; ``auto`` begins with a date and a clock, or seconds since 1970."""


@cache
def line_reader(name: str, time_format: str) -> Callable[[str, Arrival], LoggerLine]:
    """Return what reads the lines of a logger.

    Args:
        name: One of `LINE_FORMATS`, or a regular expression with a group ``values``, or groups
            ``v1``, ``v2`` and so on, and a group ``time`` if the line tells it.
        time_format: Of the group ``time``, as `csv.time_format` calls it.

    Raises:
        ConfigurationError: It is neither.

    """
    if name in LINE_FORMATS:
        return LINE_FORMATS[name]
    if '(?P<' not in name:
        msg = (
            f"format = '{name}': choose {', '.join(LINE_FORMATS)}, json, or a regular expression "
            'such as '
            r'(?P<time>\S+ \S+) T1=(?P<v1>\S+) T2=(?P<v2>\S+)'
        )
        raise ConfigurationError(msg)
    try:
        pattern = re.compile(name, re.ASCII)
    except (re.error, RecursionError) as error:
        msg = f"format = '{name}' is no regular expression: {error}"
        raise ConfigurationError(msg) from error
    singles = sorted(g for g in pattern.groupindex if re.fullmatch(r'v\d+', g))
    if not singles and 'values' not in pattern.groupindex:
        msg = f"format = '{name}' names no value: give a group values, or groups v1, v2, ..."
        raise ConfigurationError(msg)
    singles.sort(key=lambda group: int(group[1:]))
    return _of_pattern(pattern, singles, named(time_format))


def _of_pattern(
    pattern: re.Pattern[str], singles: Sequence[str], time_format: TimeFormat
) -> Callable[[str, Arrival], LoggerLine]:
    def read(text: str, arrival: Arrival) -> LoggerLine:
        found = pattern.search(text)
        if found is None:
            msg = f"it is not of the form '{pattern.pattern:.80}'"
            raise SignalError(msg)
        told = found.groupdict().get('time')
        time = arrival.now if told is None else instant_of(told, time_format, arrival)
        if singles:
            words, comma = [found[name] or '' for name in singles], False
            if not any('.' in word for word in words):
                comma = any(',' in word for word in words)
                words = [word.replace(',', '.') for word in words]
        else:
            words, comma = words_of(found['values'] or '')
        return LoggerLine(time, tuple(map(number_of, words)), comma)

    return read


def instant_of(word: str, time_format: TimeFormat, arrival: Arrival) -> float:
    """Return the time of a word [s since 1970].

    Raises:
        SignalError: It is none of that format, or outside 1990 to 2100.

    """
    try:
        instant = time_format.read(word.strip())
    except (ValueError, OverflowError) as error:
        msg = f"'{word:.40}' is no time of the format {time_format.name}: see time_format"
        raise SignalError(msg) from error
    _require_set(word, instant.seconds)
    return instant.seconds - (0.0 if instant.zoned else 3600.0 * arrival.utc_offset)


def _in_year(year: str, day: str, clock: str, arrival: Arrival) -> float:
    """Return the time of a day of the year; of the year that is nearest where none is told."""
    here = datetime.fromtimestamp(arrival.now, timezone.utc).year
    years = [year] if year else [f'{here + i}' for i in (-1, 0, 1)]
    times = [time for each in years if (time := _year_day(f'{each} {day} {clock}'))]
    if not times or not clock.strip():
        msg = f'year {year or "of the arrival"}, day {day}, clock {clock} is no time'
        raise SignalError(msg)
    offset = 3600.0 * arrival.utc_offset
    nearest = min(times, key=lambda time: abs(time - offset - arrival.now))
    _require_set(f'year {year or "of the arrival"}, day {day}', nearest)
    return nearest - offset


def _require_set(word: str, seconds: float) -> None:
    """Refuse the time of a clock that was never set, or is far beyond all loggers."""
    if not EPOCHS[0] <= seconds <= EPOCHS[1]:
        msg = (
            f"'{word:.40}' is no time from {YEARS[0]} to {YEARS[1]}: the clock of the logger was "
            'not set'
        )
        raise SignalError(msg)


def _year_day(words: str) -> float | None:
    """Return a time; None where there is none: day 366 is not in every year."""
    try:
        return FORMATS['year_day'](words).seconds
    except (ValueError, OverflowError):
        return None


def _unlike(form: str) -> SignalError:
    return SignalError(f'it is not of the form {form}')
