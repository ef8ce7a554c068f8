"""Moments of a bag as people write them: seconds after its start, a time of day, a date."""

from __future__ import annotations

import re
from datetime import datetime, timedelta, timezone
from decimal import Decimal

from agv_motion.errors import ConfigurationError

SECOND = 10**9
_DAY = 86400 * SECOND
_NUMBER = r'\d{1,12}(?:\.\d{1,9})?'
_OFFSET = re.compile(rf'([+-]?)({_NUMBER})\s*s?')
_ABSOLUTE = re.compile(rf'@({_NUMBER})')
_CLOCK = re.compile(
    r'(?:(\d{4})-(\d\d)-(\d\d)[T ])?(\d\d):(\d\d)(?::(\d\d(?:\.\d{1,9})?))?'
    r'\s*(Z|UTC|[+-]\d\d:?\d\d)?'
)
_DATE = re.compile(r'(\d{4})-(\d\d)(?:-(\d\d))?')
FORMS = (
    '90 (seconds after the start of the bag), -10 (before its end), 14:32 or 14:32:05.5 (UTC, as '
    'agv bag info prints it, else 14:32+02:00), 2024-05-03, 2024-05-03T14:32, @1714747920.5 '
    '(since 1970)'
)
"""What may be given."""


def moment(text: str, start: int, end: int) -> int:
    """Return a moment [ns since 1970].

    Args:
        text: One of ``FORMS``.
        start: [ns] of the bag, for what is relative to it.
        end: [ns] of the bag.

    Raises:
        ConfigurationError: It is none of these.

    """
    words = text.strip()
    if found := _OFFSET.fullmatch(words):
        distance = _nanoseconds(found[2])
        return max(end - distance if found[1] == '-' else start + distance, 0)
    if found := _ABSOLUTE.fullmatch(words):
        return _nanoseconds(found[1])
    if found := _DATE.fullmatch(words):
        words = f'{found[1]}-{found[2]}-{found[3] or "01"}T00:00'
    if found := _CLOCK.fullmatch(words):
        try:
            return _clock(found, start, end)
        except (ValueError, OverflowError) as error:
            msg = f"'{text}' is no time ({error}): give {FORMS}"
            raise ConfigurationError(msg) from error
    msg = f"'{text}' is no moment: give {FORMS}"
    raise ConfigurationError(msg)


def _clock(found: re.Match[str], start: int, end: int) -> int:
    """Return a date with time, or a time of day in the bag, before it or after it."""
    year, month, day, hour, minute, seconds, name = found.groups()
    zone = _zone(name or '')
    begin = datetime.fromtimestamp(start // SECOND, zone)
    date = (int(year), int(month), int(day)) if year else (begin.year, begin.month, begin.day)
    rest = Decimal(seconds or 0)
    moment = datetime(*date, int(hour), int(minute), int(rest), tzinfo=zone)
    stamp = int(moment.timestamp()) * SECOND + int(rest % 1 * SECOND)
    if not year:  # the day on which the bag has such a time, else the one that is closest to it
        stamp += max(-((stamp - start) // _DAY), 0) * _DAY
        if start - (stamp - _DAY) < stamp - end:
            stamp -= _DAY
    return max(stamp, 0)


def _zone(name: str) -> timezone:
    if name in ('', 'Z', 'UTC'):
        return timezone.utc
    away = timedelta(hours=int(name[1:3]), minutes=int(name[-2:]))
    return timezone(-away if name[0] == '-' else away)


def _nanoseconds(text: str) -> int:
    return int(Decimal(text) * SECOND)
