"""How times and ages are told."""

from __future__ import annotations

from datetime import datetime, timezone
from zoneinfo import ZoneInfo

MINUTE, HOUR, DAY = 60.0, 3600.0, 86400.0


def ago(seconds: float) -> str:
    """Return a time span in words, such as ``12 s`` or ``2 h 05 min``."""
    if seconds < 10.0:
        return f'{seconds:.1f} s'
    if seconds < 2.0 * MINUTE:
        return f'{seconds:.0f} s'
    if seconds < HOUR:
        return f'{seconds / MINUTE:.0f} min'
    if seconds < 2.0 * DAY:
        return f'{int(seconds // HOUR)} h {int(seconds % HOUR // MINUTE):02d} min'
    return f'{seconds / DAY:.0f} days'


def clock(moment: float | None, now: float, time_zone: str = 'UTC') -> str:
    """Return when a moment was, in local time: ``14:02``, with the date where that is another.

    Args:
        moment: [s since 1970]; None: nobody knows.
        now: The same.
        time_zone: IANA name; one that is not known counts as UTC.

    Returns:
        The time; empty where nobody knows it.

    """
    if moment is None:
        return ''
    try:
        zone = ZoneInfo(time_zone)
    except (LookupError, ValueError, OSError):
        zone = ZoneInfo('UTC')
    try:
        told, today = (
            datetime.fromtimestamp(each, timezone.utc).astimezone(zone) for each in (moment, now)
        )
    except (OverflowError, ValueError, OSError):
        return ''
    return f'{told:%H:%M}' if told.date() == today.date() else f'{told:%Y-%m-%d %H:%M}'
