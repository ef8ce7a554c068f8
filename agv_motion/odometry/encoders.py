"""Readings of wheel encoders: how far each wheel rolled, whatever stamps and counters do."""

from __future__ import annotations

from math import inf
from operator import mul, sub
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.odometry.continuity import Continuity, Succession
from agv_motion.odometry.gates import MAX_ANGLE, require_within
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.odometry.parameters import OdometryParameters

MOVED = Succession.MOVED
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
        self._gap_noise = parameters.gap_noise
        self._range = parameters.encoder_range
        self._max_rolled = parameters.max_wheel_speed * len(self._radii)
        self._order = Continuity[list[float]](parameters.max_gap, self._possible)
        self._stamp = -inf
        self._angles: list[float] = []
        self.duration = 0.0
        """[s] between the last two readings"""
        self.travel: Sequence[float] = ()
        """(n,) [m] distance that each wheel is known to have rolled meanwhile; empty at first"""
        self.beyond: Sequence[float] = ()
        """(n,) [m] at a leap of the clock: what each rolled before, in a time that nobody knows"""
        self.rolled = 0.0
        """[m] sum of the travels, all counted positive"""
        self.doubt = 0.0
        """[m] standard deviation of what a wheel may have rolled unseen, or is a guess"""

    @property
    def stamp(self) -> float | None:
        """Time of the last reading [s]; None before the first."""
        return self._stamp if self._stamp > -inf else None

    def read(self, stamp: float, angles: Sequence[float], *, by_rate: bool = False) -> Succession:
        """Take a reading and work out the travel since the one before.

        Args:
            stamp: Time of the reading [s].
            angles: (n,) angle of each wheel [rad].
            by_rate: Whether angles are added-up rates, which tell nothing of what was not seen.

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
        if len(angles) != len(self._radii):
            self._require(angles)
        if not (0.0 < duration <= self._max_gap and rolled <= self._max_rolled * duration) or (
            by_rate and self._order.doubts
        ):
            return self._judge(stamp, list(angles), by_rate=by_rate)
        self._stamp, self._angles = stamp, list(angles)
        self._order.follow(stamp, self._angles)
        self.doubt = self._uneven(travel, duration) if by_rate else 0.0
        self.duration, self.travel, self.rolled = duration, travel, rolled
        return MOVED

    def set_angles(self, angles: dict[int, float]) -> None:
        """Take some wheels, by number, to have stood at ``angles`` [rad] in the last reading."""
        for wheel, angle in angles.items():
            if self._angles:
                self._angles[wheel] = angle
        self._order.replace(self._angles)

    def _judge(self, stamp: float, angles: list[float], *, by_rate: bool) -> Succession:
        """Take a reading that does not plainly follow the last."""
        self._require(angles)
        order, before = self._order, self._angles
        step = order.judge(stamp, angles)
        if not step.used:
            return step
        since, speed = self._stamp, self._speed()
        self._stamp, self._angles = stamp, angles
        if step is Succession.FIRST:
            return step
        if order.begun is not None and step in {Succession.LEAP, Succession.RESET}:
            since = order.begun.stamp
            self.beyond = self._travel(before, order.begun.value)
            before = order.begun.value
        elif step is Succession.GAP and self._may_have_gone_round(stamp - since):
            step, before = Succession.RESET, angles
        duration, travel = stamp - since, self._travel(before, angles)
        uneven = self._uneven(travel, duration) if by_rate else 0.0
        self.duration, self.travel, self.rolled = duration, travel, sum(map(abs, travel))
        self.doubt = uneven + self._doubt(step, max(speed, self._speed()), by_rate=by_rate)
        return step

    def _doubt(self, step: Succession, speed: float, *, by_rate: bool) -> float:
        """Return how far a wheel may have rolled beyond what is known [m].

        Args:
            step: What the reading was good for.
            speed: Mean of the wheels [m/s] before or after what was not seen, whichever is more.
            by_rate: Whether nothing counted meanwhile.

        """
        if step is Succession.RESET or by_rate:
            return speed * self._order.unseen
        unsure = {
            Succession.GAP: self._gap_noise * self.rolled,
            Succession.LEAP: sum(map(abs, self.beyond)),
        }
        return unsure.get(step, 0.0) / len(self._radii)

    def _uneven(self, travel: Sequence[float], duration: float) -> float:
        """Return how far a wheel [m] may be wrong whose speed changed: when it did is not known."""
        if not self.duration or len(self.travel) != len(travel):
            return 0.0
        share = duration / self.duration
        return max(abs(now - share * last) for now, last in zip(travel, self.travel, strict=True))

    def _speed(self) -> float:
        """Return the mean speed of the wheels over the last step [m/s]."""
        return self.rolled / (self.duration * len(self._radii)) if self.duration else 0.0

    def _travel(self, before: Sequence[float], after: Sequence[float]) -> list[float]:
        turned: Iterable[float] = map(sub, after, before)
        if self._range:
            half = 0.5 * self._range
            turned = [(angle + half) % self._range - half for angle in turned]
        return list(map(mul, turned, self._radii))

    def _possible(self, before: list[float], after: list[float], duration: float) -> bool:
        """Return whether the wheels can have turned like that in that time."""
        return sum(map(abs, self._travel(before, after))) <= self._max_rolled * duration

    def _may_have_gone_round(self, duration: float) -> bool:
        """Return whether encoders that wrap may have done so any number of times meanwhile."""
        half_way_round = 0.5 * self._range * sum(self._radii)
        return 0.0 < half_way_round < self._max_rolled * duration

    def _require(self, angles: Sequence[float]) -> None:
        """Raise unless there is one finite angle for each wheel."""
        if len(angles) != len(self._radii):
            msg = f'{len(angles)} wheel angles for {len(self._radii)} wheels: give one each'
            raise SignalError(msg)
        require_finite('wheel angles', tuple(angles))
        require_within('wheel angles', angles, MAX_ANGLE, 'rad', 'look at the encoders')
