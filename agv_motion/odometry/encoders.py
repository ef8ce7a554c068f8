"""Readings of wheel encoders: how far each wheel rolled, whatever stamps and counters do."""

from __future__ import annotations

from enum import Enum
from math import inf
from operator import mul, sub
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.odometry.parameters import OdometryParameters

CLOCK_SET_BACK = 10.0
"""[s] A stamp that much before the last is no late message: time itself began again."""


class Step(Enum):
    """What a reading of the encoders was good for."""

    MOVED = 'moved'
    GAP = 'after a gap: the path between is a guess'
    FIRST = 'first reading'
    RESET = 'encoders or clock jumped: the motion between is lost'
    DUPLICATE = 'stamp seen before: ignored'
    LATE = 'older than the last: ignored, the encoders count on'


MOVED = Step.MOVED
"""An attribute of an enumeration costs ten times a global: this one is read at every step."""


class Encoders:
    """Turns angles that count on, wrap around or start again into travels."""

    def __init__(self, wheel_radii: Sequence[float], parameters: OdometryParameters) -> None:
        """Wait for the first reading.

        Args:
            wheel_radii: (n,) rolling radius of each wheel [m].
            parameters: What a plausible reading is.

        Raises:
            ConfigurationError: A radius is not a finite number above zero.

        """
        self._radii = tuple(map(float, wheel_radii))
        if not all(0.0 < radius < inf for radius in self._radii):
            msg = f'wheel_radii = {self._radii}: give finite numbers above 0 [m]'
            raise ConfigurationError(msg)
        self._max_gap = parameters.max_gap
        self._range = parameters.encoder_range
        self._max_rolled = parameters.max_wheel_speed * len(self._radii)
        self._stamp = -inf
        self._angles: list[float] = []
        self.duration = 0.0
        """[s] between the last two readings"""
        self.travel: Sequence[float] = ()
        """(n,) [m] distance that each wheel rolled meanwhile; empty where that is lost"""
        self.rolled = 0.0
        """[m] sum of the travels, all counted positive; where lost, what it was likely to be"""

    @property
    def stamp(self) -> float | None:
        """Time of the last reading [s]; None before the first."""
        return self._stamp if self._stamp > -inf else None

    def read(self, stamp: float, angles: Sequence[float]) -> Step:
        """Take a reading and work out the travel since the one before.

        Args:
            stamp: Time of the reading [s].
            angles: (n,) angle of each wheel [rad].

        Raises:
            SignalError: A wrong number of values, or one that is not finite; nothing has changed.

        """
        duration = stamp - self._stamp
        turned: Iterable[float] = map(sub, angles, self._angles)
        if self._range:
            half = 0.5 * self._range
            turned = [(angle + half) % self._range - half for angle in turned]
        travel = list(map(mul, turned, self._radii))
        rolled = sum(map(abs, travel))
        step = MOVED
        if not (0.0 < duration <= self._max_gap and rolled <= self._max_rolled * duration):
            step = self._judge(stamp, duration, angles, rolled)
            if step is Step.DUPLICATE or step is Step.LATE:
                return step
            if step is not Step.GAP:
                travel, rolled = [], self._missed(duration)
        if len(angles) != len(self._radii):
            self._require(angles)
        self.duration, self.travel, self.rolled = duration, travel, rolled
        self._stamp, self._angles = stamp, list(angles)
        return step

    def set_angles(self, angles: dict[int, float]) -> None:
        """Take some wheels, by number, to have stood at ``angles`` [rad] in the last reading."""
        for wheel, angle in angles.items():
            if self._angles:
                self._angles[wheel] = angle

    def _judge(self, stamp: float, duration: float, angles: Sequence[float], rolled: float) -> Step:
        """Return what a reading means that does not plausibly follow the last."""
        require_finite('stamp', (stamp,))
        if self._stamp > -inf:
            if duration == 0.0:
                return Step.DUPLICATE
            if -CLOCK_SET_BACK < duration < 0.0:
                return Step.LATE
        self._require(angles)
        if self._stamp == -inf:
            return Step.FIRST
        if duration < 0.0 or rolled > self._max_rolled * duration:
            return Step.RESET
        # over so long a gap the encoders may have gone round any number of times
        half_way_round = 0.5 * self._range * sum(self._radii)
        return Step.RESET if 0.0 < half_way_round < self._max_rolled * duration else Step.GAP

    def _missed(self, duration: float) -> float:
        """Return what the wheels would have rolled at their last speeds [m]."""
        speed = self.rolled / self.duration if self.duration else 0.0
        return speed * max(duration, 0.0) if speed else 0.0  # the duration may be infinite

    def _require(self, angles: Sequence[float]) -> None:
        """Raise unless there is one finite angle for each wheel."""
        if len(angles) != len(self._radii):
            msg = f'{len(angles)} wheel angles for {len(self._radii)} wheels: give one each'
            raise SignalError(msg)
        require_finite('wheel angles', tuple(angles))
