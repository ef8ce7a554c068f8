"""One line of a data logger, read as a person would: a time, then the values of the probes.

Loggers differ in how they write the same line: the date, what stands between the values, a decimal
comma, the number of the record before, control characters round it. What has one reading only is
read; what has none, or several, is refused with its reason.
"""

from __future__ import annotations

import re
from datetime import datetime, timedelta, timezone
from math import isfinite, nan
from typing import NamedTuple

from agv_motion.errors import SignalError
from agv_motion.probe.tables.signs import NUMBER
from agv_motion.probe.tables.time_readers import offset_of

EXPECTED = 'expected DD-MM-YY HH:MM:SS v1 v2 ...'

YEARS = (2001, 2069)
"""A logger whose clock was never set begins in 1970 or 2000."""

EPOCHS = (1e9, 3.1e9)
"""[s] since 1970 of those years; a smaller number counts from when the logger was switched on."""

LONGEST_LINE = 1024
"""Letters; what is longer is rubbish, and a pattern may search it for seconds."""

MISSING = {-9999.0, -99999.0, -6999.0, -7999.0, 6999.0, 7999.0}
"""What loggers write where there is no value."""

_CONTROL = ''.join(map(chr, range(0x20))) + '\x7f '
_CLOCK = (
    r'(?P<hour>\d{1,2}):(?P<minute>\d{2})(?::(?P<second>\d{2}(?:\.\d{1,9})?))?'
    r'(?P<zone>Z|[+-]\d{2}:?\d{2})?'
)
_GAP = r'[\s,;]+'
_DAY_FIRST = r'(?P<day>\d{1,2})(?P<to>[-./])(?P<month>\d{1,2})(?P=to)(?P<year>\d{4}|\d{2})'
_YEAR_FIRST = r'(?P<year>\d{4})(?P<to>[-/])(?P<month>\d{1,2})(?P=to)(?P<day>\d{1,2})'
_DATED = tuple(
    re.compile(rf'(?:\d{{1,9}}{_GAP})?{date}(?:T|{_GAP}){_CLOCK}(?=[\s,;]|$)', re.ASCII)
    for date in (_DAY_FIRST, _YEAR_FIRST)
)
_EPOCH = re.compile(r'(?P<epoch>\d{1,12}(?:\.\d{1,9})?)(?=[\s,;])', re.ASCII)
_HALF_DAY = re.compile(r'[\s,;]*[AaPp]\.?[Mm]\b')
_NO_VALUE = {'nan', 'na', 'n/a', 'null', 'none', '-', '--', '---', ''}
_DECIMAL_COMMA = re.compile(r'[+-]?\d+,\d+', re.ASCII)


class LoggerLine(NamedTuple):
    """What one line tells."""

    time: float
    """[s] since 1970, UTC"""
    values: tuple[float, ...]
    """in the unit of the logger; NaN where there is none"""
    decimal_comma: bool
    """whether commas were read as points"""


def cleaned(line: bytes) -> str:
    """Return the text of a line without the control characters before and after it."""
    return line.decode('ascii', errors='replace').strip(_CONTROL)


def read_line(text: str, utc_offset: float = 0.0) -> LoggerLine:
    """Return what a line tells.

    Args:
        text: The line; day before month, and a year of two digits is of this century.
        utc_offset: Time of the logger minus UTC [h]; a line that tells its zone, or the seconds
            since 1970, needs none.

    Raises:
        SignalError: It has no time, no calendar day, or separators that may be read in two ways.

    """
    text = text.replace('"', '')
    for form in _DATED:
        found = form.match(text)
        if found:
            time = _moment(found, utc_offset)
            break
    else:
        found = _EPOCH.match(text)
        if found is None or not EPOCHS[0] <= float(found['epoch']) <= EPOCHS[1]:
            msg = f'no time that can be known: {EXPECTED}'
            raise SignalError(msg)
        time = float(found['epoch'])
    rest = text[found.end() :]
    if _HALF_DAY.match(rest):
        msg = 'a clock of twelve hours: give a regular expression as format, and time_format'
        raise SignalError(msg)
    words, decimal_comma = words_of(rest)
    return LoggerLine(time, tuple(number_of(word) for word in words), decimal_comma)


def _moment(found: re.Match[str], utc_offset: float) -> float:
    """Return the time of a match [s since 1970].

    Raises:
        SignalError: There is no such day or hour, or no logger was there to see it.

    """
    day, month, year, hour, minute = (
        int(found[name]) for name in ('day', 'month', 'year', 'hour', 'minute')
    )
    year += 2000 if len(found['year']) == 2 else 0
    if not YEARS[0] <= year <= YEARS[1]:
        msg = f'the year is {year}: the clock of the logger was not set; {EXPECTED}'
        raise SignalError(msg)
    second = float(found['second'] or 0.0)
    midnight = hour == 24 and minute == 0 == second
    try:
        moment = datetime(year, month, day, 0 if midnight else hour, minute, tzinfo=timezone.utc)
        if second >= 60.0:
            raise ValueError(second)  # noqa: TRY301 - as datetime does of minutes
    except ValueError as error:
        msg = f'no such time ({error}): {EXPECTED}, the day before the month'
        raise SignalError(msg) from error
    try:
        told = offset_of(found['zone'])
    except ValueError as error:
        msg = f'no such zone ({error})'
        raise SignalError(msg) from error
    offset = utc_offset * 3600.0 if told is None else told
    return (moment + timedelta(days=midnight)).timestamp() + second - offset


def words_of(rest: str) -> tuple[list[str], bool]:
    """Return the words of the values, and whether their commas are decimal.

    Raises:
        SignalError: Commas may separate values or be decimal, or each value has a label or unit,
            by which all but the first would count as another.

    """
    words, decimal_comma = _separated(rest)
    numbers = [bool(NUMBER.fullmatch(word)) for word in words]
    labels = [not NUMBER.fullmatch(word) and word.lower() not in _NO_VALUE for word in words]
    for first, second in ((labels, numbers), (numbers, labels)):
        if len(words) > 3 and all(first[0::2]) and all(second[1::2]):
            msg = (
                f"a word stands beside each value ('{words[0]:.20} {words[1]:.20}'): give a "
                'regular expression as format'
            )
            raise SignalError(msg)
    return words, decimal_comma


def _separated(rest: str) -> tuple[list[str], bool]:
    rest = rest.strip().removesuffix(',').removesuffix(';').rstrip()
    if ';' in rest:
        first = rest.lstrip().startswith(';')
        words = [word.strip() for word in rest.removeprefix(';').split(';')]
        if not first and rest.startswith(','):
            msg = f'both , and ; stand between its values: {EXPECTED}'
            raise SignalError(msg)
        return _pointed(words)
    if rest.startswith(','):
        words = [word.strip() for word in rest[1:].split(',')]
        whole = all('.' not in word for word in words)
        if whole and len(words) > 2 and not len(words) % 2:
            msg = f'its commas may be decimal or stand between values: {EXPECTED}'
            raise SignalError(msg)
        return words, False
    if '.' in rest:
        return [word for word in re.split(r'[\s,]+', rest) if word], False
    return _pointed([word.removesuffix(',') for word in rest.split()])


def _pointed(words: list[str]) -> tuple[list[str], bool]:
    """Return words with points in place of decimal commas, and whether there were any.

    Raises:
        SignalError: A word has several commas, or a comma beside a point.

    """
    comma = False
    for i, word in enumerate(words):
        if ',' in word:
            if not _DECIMAL_COMMA.fullmatch(word):
                msg = f"the commas of '{word:.40}' may be decimal or stand between: {EXPECTED}"
                raise SignalError(msg)
            words[i], comma = word.replace(',', '.'), True
    return words, comma


def number_of(word: str) -> float:
    """Return the number of a word; NaN where it is none, or stands for none."""
    number = float(word) if NUMBER.fullmatch(word) else nan
    return nan if number in MISSING or not isfinite(number) else number
