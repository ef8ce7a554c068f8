"""The clock of a logger in UTC: a fixed offset, or a zone with its summer time."""

from __future__ import annotations

import re
from datetime import datetime, timedelta, timezone
from enum import Enum
from typing import TYPE_CHECKING
from zoneinfo import ZoneInfo

from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from datetime import tzinfo

    from agv_motion.probe.tables.time_readers import Instant


class DoubledHour(Enum):
    """What the hour means that a clock shows twice in autumn."""

    IN_ORDER = 'in_order'
    """the first pass, until it comes again"""
    FIRST = 'first'
    SECOND = 'second'


_FIXED = re.compile(r'(?:UTC|GMT)?(?P<sign>[+-])(?P<hours>\d{1,2})(?::?(?P<minutes>\d{2}))?')
_EPOCH = datetime(1970, 1, 1, tzinfo=timezone.utc)


def zone_of(name: str) -> tzinfo:
    """Return a zone by its name: `UTC`, `UTC+1`, `+01:00`, or of the IANA, `Europe/Zurich`.

    Raises:
        ConfigurationError: There is none of that name.

    """
    if name in {'', 'UTC', 'Z'}:
        return timezone.utc
    if found := _FIXED.fullmatch(name):
        minutes = 60 * int(found['hours']) + int(found['minutes'] or 0)
        if minutes <= 14 * 60:
            return timezone(timedelta(minutes=-minutes if found['sign'] == '-' else minutes))
    else:
        try:
            return ZoneInfo(name)
        except (KeyError, ValueError, OSError):
            pass
    msg = f"time_zone = '{name}': give UTC, an offset such as UTC+1, or a name as Europe/Zurich"
    raise ConfigurationError(msg)


def solar_offset(name: str, time: float) -> float:
    """Return by how much the solar time of a zone is ahead of UTC [h], as its clocks in winter are.

    A clock is up to an hour or two off the sun: who knows the longitude divides it by 15.

    Args:
        name: Of the zone, as :func:`zone_of` takes it.
        time: At which the zone is asked [s since 1970].

    Raises:
        ConfigurationError: There is no zone of that name.

    """
    zone = zone_of(name)
    year = datetime.fromtimestamp(time, zone).year
    ahead = (datetime(year, month, 1, tzinfo=zone).utcoffset() for month in (1, 7))
    return min((offset or timedelta()).total_seconds() for offset in ahead) / 3600.0


class LocalClock:
    """Turns what the clock of a logger showed, row after row as time went on, into UTC."""

    def __init__(self, zone: tzinfo, doubled_hour: DoubledHour) -> None:
        """Start before the first row.

        Args:
            zone: Where the clock was.
            doubled_hour: What its doubled hour means.

        """
        self._zone, self._rule = zone, doubled_hour
        self._fixed = zone.utcoffset(None)
        self._last = float('-inf')

    def utc(self, instant: Instant) -> float:
        """Return the time of the next row in UTC [s since 1970].

        Raises:
            SourceError: The clock cannot have shown that: the hour was left out in spring.

        """
        if instant.zoned:
            self._last = instant.seconds
        elif self._fixed is not None:
            self._last = instant.seconds - self._fixed.total_seconds()
        else:
            self._last = self._of_zone(instant.seconds)
        return self._last

    def _of_zone(self, shown: float) -> float:
        moment = _EPOCH + timedelta(seconds=shown)
        first, second = (
            moment.replace(tzinfo=self._zone, fold=fold).timestamp() for fold in (0, 1)
        )
        if first == second:
            return first
        if first > second:  # a clock that goes forward has never shown it
            words = f'{moment:%Y-%m-%d %H:%M}'
            msg = (
                f'there was no {words} in {self._zone}: the logger keeps no summer time there; '
                f'give its offset, such as csv.time_zone: UTC+1'
            )
            raise SourceError(msg)
        if self._rule is DoubledHour.IN_ORDER:
            return first if first > self._last else second
        return first if self._rule is DoubledHour.FIRST else second
