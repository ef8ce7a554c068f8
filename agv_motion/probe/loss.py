"""A probe that is lost: what stands in for it, step by step, until the tree must rest.

Its last sap flow is held; then it goes on by the trend of its last hour; then as it usually is at
this hour of the day; then nothing is known. Only what was measured is ever learnt from.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from enum import Enum
from math import isfinite
from typing import Annotated, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.probe.noise import DOUBTFUL

HOUR = 3600.0
KEPT = 6.0 * HOUR
"""[s] Readings that are remembered, and at least one more than may turn out to be noise."""


class LossStep(Enum):
    """What a sap flow is known by, from the best to the least."""

    MEASURED = 'measured'
    HELD = 'held'
    TREND = 'by the trend of its last hour'
    CLIMATOLOGY = 'as usual at this hour, by half'
    LOST = 'lost'


@dataclass(frozen=True)
class LossParameters:
    """How long each step lasts when a probe is lost; 0 leaves it out. All 0: rest at once."""

    hold: Annotated[float, Spec('the last sap flow is held', 's', (0.0, 86400.0))] = 0.0
    trend: Annotated[
        float, Spec('then it goes on by the trend of its last hour', 's', (0.0, 86400.0))
    ] = 0.0
    climatology: Annotated[
        float, Spec('then as usual at this hour of the day, by half', 's', (0.0, 604800.0))
    ] = 0.0
    climatology_days: Annotated[int, Spec('days whose mean is usual', 'd', (1, 60))] = 7
    enough: Annotated[
        int,
        Spec('signals that must be known: 2, and the mean of two stands in for the third', '1',
             (2, 3)),
    ] = 3  # fmt: skip

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @property
    def stands_in(self) -> bool:
        """Whether anything stands in for what is lost."""
        return self.hold + self.trend + self.climatology > 0.0


class SapFlowEstimate(NamedTuple):
    """What is known of a sap flow, and by what."""

    value: float | None
    """[-] in [0, 1]; None where nothing is known"""
    step: LossStep


NOTHING = SapFlowEstimate(None, LossStep.LOST)


class DayCourse:
    """The usual sap flow of each hour of the day: the mean of the last days."""

    def __init__(self, days: int) -> None:
        """Know of no day."""
        self._days = days
        self._hours: dict[int, deque[float]] = {}
        self._open: tuple[int, float, int] | None = None
        """number of the hour since 1970, sum and count of its values"""

    def add(self, time: float, value: float) -> None:
        """Take in what was measured at ``time`` [s]."""
        hour = int(time // HOUR)
        if self._open is None:
            self._open = hour, value, 1
            return
        number, total, count = self._open
        if number == hour:
            self._open = hour, total + value, count + 1
        else:
            past = self._hours.setdefault(number % 24, deque(maxlen=self._days))
            past.append(total / count)
            self._open = hour, value, 1

    def at(self, time: float) -> float | None:
        """Return what is usual at ``time`` [s]; None where that hour was never measured."""
        past = self._hours.get(int(time // HOUR) % 24)
        return sum(past) / len(past) if past else None

    def state(self) -> list[list[float]]:
        """Return the hours, each with its days."""
        return [[hour, *past] for hour, past in self._hours.items()]

    def restore(self, state: Any) -> None:
        """Take up a :meth:`state`.

        Raises:
            ConfigurationError: It is not one.

        """
        try:
            hours = {int(hour): [float(value) for value in past] for hour, *past in state}
            if not all(isfinite(v) and 0.0 <= v <= 1.0 for past in hours.values() for v in past):
                raise ValueError(hours)  # noqa: TRY301 - as unreadable as the rest
        except (TypeError, ValueError, OverflowError) as error:
            msg = f'saved course of the day is unreadable ({error!r:.120}): delete the state file'
            raise ConfigurationError(msg) from error
        self._hours = {
            hour: deque(past, maxlen=self._days)
            for hour, past in hours.items()
            if 0 <= hour < 24 and past
        }


class LossLadder:
    """Goes down step by step from the last sap flow that was measured."""

    def __init__(self, parameters: LossParameters) -> None:
        """Know of no sap flow."""
        self._given = parameters
        self._past: deque[tuple[float, float]] = deque()
        """what the course of the day has not learnt yet, since it may be taken back"""
        self.course = DayCourse(parameters.climatology_days)

    def update(self, time: float, measured: float | None) -> SapFlowEstimate:
        """Return what is known of the sap flow at ``time`` [s]; ``measured`` None if it is lost."""
        if measured is not None:
            return self._measured(time, measured)
        if not self._past or time < self._past[-1][0]:
            self._past.clear()  # never measured, or a clock set back: the past is no guide
            return NOTHING
        last, value = self._past[-1]
        lost, given = time - last, self._given
        if lost <= given.hold:
            return SapFlowEstimate(value, LossStep.HELD)
        lost -= given.hold
        if lost <= given.trend:
            return SapFlowEstimate(min(max(value + self._slope() * lost, 0.0), 1.0), LossStep.TREND)
        usual = self.course.at(time)
        if lost - given.trend <= given.climatology and usual is not None:
            return SapFlowEstimate(usual, LossStep.CLIMATOLOGY)
        return NOTHING

    def distrust(self, since: float) -> None:
        """Take back what was measured from ``since`` [s] on: it was noise before it was known."""
        while self._past and self._past[-1][0] >= since:
            self._past.pop()

    def _measured(self, time: float, value: float) -> SapFlowEstimate:
        if self._past and time < self._past[-1][0]:
            self._past.clear()
        self._past.append((time, value))
        while len(self._past) > DOUBTFUL + 1 and time - self._past[0][0] > KEPT:
            self.course.add(*self._past.popleft())
        return SapFlowEstimate(value, LossStep.MEASURED)

    def _slope(self) -> float:
        """Return the slope of the line through the last hour [1/s]; 0 of a single reading."""
        origin = self._past[-1][0]
        rows = [(time - origin, value) for time, value in self._past if origin - time <= HOUR]
        mean_time = sum(time for time, _ in rows) / len(rows)
        mean = sum(value for _, value in rows) / len(rows)
        spread = sum((time - mean_time) ** 2 for time, _ in rows)
        rise = sum((time - mean_time) * (value - mean) for time, value in rows)
        return rise / spread if spread > 0.0 else 0.0
