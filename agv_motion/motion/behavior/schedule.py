"""When the tree may walk: opening hours and days in local time, and never before dawn.

Before dawn the probes learn their zero flow, so the tree must stand; those hours are those of the
probes, in local solar time. A pure function of time.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime, time, timedelta, timezone
from enum import Enum
from typing import Annotated, NamedTuple
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from agv_motion.activity import Activity, Cause
from agv_motion.errors import ConfigurationError
from agv_motion.parameters import TIME_OF_DAY, Spec, check

DAYS = ('mon', 'tue', 'wed', 'thu', 'fri', 'sat', 'sun')
DAY = 86400.0

LOOKED_AT = range(-1, 16)
"""[d] from today on: two weeks, for where the clocks leave out the only hours of one."""


@dataclass(frozen=True)
class ScheduleParameters:
    """Opening hours, and the hours in which the probes calibrate."""

    enabled: Annotated[
        bool, Spec('keep these hours; false: walk whenever the sap flows', dynamic=True)
    ] = False
    time_zone: Annotated[
        str, Spec('IANA name of the local time, such as Europe/Paris', dynamic=True)
    ] = 'UTC'
    opens: Annotated[str, Spec('local time', TIME_OF_DAY, dynamic=True)] = '10:00'
    closes: Annotated[
        str, Spec('local time; before opens: on the next day', TIME_OF_DAY, dynamic=True)
    ] = '18:00'
    days: Annotated[tuple[str, ...], Spec('on which it opens', choices=DAYS, dynamic=True)] = DAYS[
        :6
    ]
    night_start: Annotated[
        float,
        Spec(
            'start of the hours in which the probes calibrate, local solar time',
            'h',
            (0.0, 24.0),
            dynamic=True,
        ),
    ] = 2.0
    night_end: Annotated[
        float,
        Spec('end of these hours; the tree rests until then', 'h', (0.0, 24.0), dynamic=True),
    ] = 7.0
    solar_offset: Annotated[
        float,
        Spec('local solar time minus UTC, longitude / 15', 'h', (-14.0, 14.0), dynamic=True),
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row, and that the hours and their zone exist."""
        check(self)
        self.zone()
        if self.opening() == self.closing():
            msg = f'opens = closes = {self.opens}: give two times, or enabled: false for all hours'
            raise ConfigurationError(msg)
        if not self.days:
            msg = f'days = []: give at least one of {", ".join(DAYS)}'
            raise ConfigurationError(msg)
        if self.night_start > self.night_end:
            msg = (
                f'night_start = {self.night_start} is after night_end = {self.night_end}: '
                'the hours before dawn lie in one day'
            )
            raise ConfigurationError(msg)

    def zone(self) -> ZoneInfo:
        """Return the time zone.

        Raises:
            ConfigurationError: There is none of that name.

        """
        try:
            return ZoneInfo(self.time_zone)
        except (ZoneInfoNotFoundError, ValueError, OSError) as error:
            msg = (
                f"time_zone = '{self.time_zone}': give an IANA name such as Europe/Paris "
                '(where none is known: pip install tzdata)'
            )
            raise ConfigurationError(msg) from error

    def opening(self) -> time:
        """Return the local time of opening."""
        return _time('opens', self.opens)

    def closing(self) -> time:
        """Return the local time of closing."""
        return _time('closes', self.closes)


class Phase(Enum):
    """What the hour is for."""

    OPEN = 'open'
    CLOSED = 'closed'
    CALIBRATING = 'the probes calibrate'
    ASKED = 'as asked'

    def sentence(self, until: str) -> str:
        """Return what a tree that rests in it says; ``until`` when, in words."""
        if self is Phase.ASKED:
            return f'resting until {until}, {self.value}'
        return f'resting: {self.value} until {until}'

    @property
    def means(self) -> tuple[Activity, Cause]:
        """What a tree that rests in it does, for programs, and what that goes back to."""
        if self is Phase.ASKED:
            return Activity.RESTING, Cause.PERSON
        return Activity.CLOSED, Cause.HOURS


class Hour(NamedTuple):
    """What the hour is for, and until when."""

    phase: Phase
    until: float
    """[s since 1970] when it may change; infinite: never"""


ALWAYS = Hour(Phase.OPEN, float('inf'))


class Schedule:
    """Opening hours as a function of time."""

    def __init__(self, parameters: ScheduleParameters, rest_until: float = 0.0) -> None:
        """Keep the hours of ``parameters``, and rest until a time [s since 1970]; 0: do not."""
        self.parameters, self.rest_until = parameters, rest_until
        self._zone = parameters.zone()
        self._opening, self._closing = parameters.opening(), parameters.closing()
        self._days = {DAYS.index(day) for day in parameters.days}

    def hour(self, now: float) -> Hour:
        """Return what the hour is for at ``now`` [s since 1970], and until when.

        A rest that somebody asked for wins over all, hours before dawn over opening hours.
        """
        if now < self.rest_until:
            return Hour(Phase.ASKED, self.rest_until)
        given = self.parameters
        if not given.enabled:
            return ALWAYS
        second = (now + given.solar_offset * 3600.0) % DAY
        start, end = given.night_start * 3600.0, given.night_end * 3600.0
        if start <= second < end:
            return Hour(Phase.CALIBRATING, now + end - second)
        night = now + (start - second if second < start else start + DAY - second)
        night = night if end > start else float('inf')
        today = self.local(now).date()
        intervals = [self._interval(today + timedelta(days=k)) for k in LOOKED_AT]
        for opens, closes in intervals:
            if opens <= now < closes:
                return Hour(Phase.OPEN, min(closes, night))
        return Hour(Phase.CLOSED, min(opens for opens, closes in intervals if now < opens < closes))

    def local(self, now: float) -> datetime:
        """Return a moment [s since 1970] in local time."""
        return datetime.fromtimestamp(now, timezone.utc).astimezone(self._zone)

    def clock(self, moment: float) -> str:
        """Return a moment [s since 1970] in local time in words, such as ``Mon 10:00``."""
        local = self.local(moment)
        return f'{DAYS[local.weekday()].capitalize()} {local:%H:%M}'

    def _interval(self, day: date) -> tuple[float, float]:
        """Return opening and closing on a day [s since 1970]; twice the same where it is shut."""
        opens = datetime.combine(day, self._opening, self._zone)
        if day.weekday() not in self._days:
            return opens.timestamp(), opens.timestamp()
        last = day if self._opening < self._closing else day + timedelta(days=1)
        return opens.timestamp(), datetime.combine(last, self._closing, self._zone).timestamp()


def _time(name: str, text: str) -> time:
    try:
        return datetime.strptime(text, '%H:%M').replace(tzinfo=timezone.utc).time()
    except ValueError as error:
        msg = f"{name} = '{text}': give HH:MM, such as 10:00"
        raise ConfigurationError(msg) from error
