"""One angle a wheel from whatever its motor tells: a position, a rate, or now one, now the other.

What two positions tell of the way between them is kept; where there are only rates they are added
up by the trapezoidal rule, over the time that has passed by the one rule of `continuity`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.odometry.continuity import Continuity, Step
from agv_motion.odometry.gates import require_within

if TYPE_CHECKING:
    from collections.abc import Sequence


class WheelAngles:
    """Counts the turns of n wheels; a wheel of which only rates are known counts from 0."""

    def __init__(self, count: int, max_gap: float, max_rate: float) -> None:
        """Wait for the first reading.

        Args:
            count: Of the wheels.
            max_gap: Silence beyond which rates tell nothing sure [s].
            max_rate: Fastest that a wheel turns [rad/s].

        """
        self._none: list[float | None] = [None] * count
        self._order = Continuity[Sequence[float | None]](max_gap, lambda *_: True)
        self._max_rate = max_rate
        self._angles: list[float | None] = [0.0] * count
        self._offsets = self._none
        """From a position as it is told to the angle that is counted"""
        self.by_rate = False
        """Whether the last angles rest on rates"""

    def add(
        self, stamp: float, positions: Sequence[float | None], rates: Sequence[float | None]
    ) -> list[float | None]:
        """Return (n,) angles [rad] at ``stamp`` [s]; None for a wheel that tells nothing.

        Over the step in which a wheel without positions falls silent or comes back its angle stands
        still: such a step has to be done without it. A stamp that does not follow adds nothing.

        Args:
            stamp: Time of the reading [s].
            positions: (n,) angle of each wheel [rad], None where unknown; or empty.
            rates: (n,) rate of each wheel [rad/s], None where unknown; or empty.

        Raises:
            SignalError: A rate that a wheel needs is beyond its limit; nothing has changed.

        """
        positions, rates = positions or self._none, rates or self._none
        pairs = list(zip(positions, rates, strict=True))
        self.by_rate = any(position is None and rate is not None for position, rate in pairs)
        if self.by_rate:
            needed = [rate for position, rate in pairs if position is None and rate is not None]
            require_within('wheel rates', needed, self._max_rate, 'rad/s', 'look at the encoders')
        before, last = self._order.stamp, self._order.last
        step = self._order.judge(stamp, rates)
        if step.used:
            if step is Step.LEAP and self._order.begun is not None:
                before, last = self._order.begun.stamp, self._order.begun
            elapsed = 0.0 if step is Step.FIRST else stamp - before
            known = self._none if last is None else last.value
            self._count(positions, rates, known, elapsed)
        return [
            None if position is None and rate is None else angle
            for (position, rate), angle in zip(pairs, self._angles, strict=True)
        ]

    def _count(
        self,
        positions: Sequence[float | None],
        rates: Sequence[float | None],
        last: Sequence[float | None],
        elapsed: float,
    ) -> None:
        """Carry each angle on over ``elapsed`` [s], with the rates now and those before."""
        for i, (position, now, before) in enumerate(zip(positions, rates, last, strict=True)):
            angle, offset = self._angles[i] or 0.0, self._offsets[i]
            if now is not None and (before is not None or offset is not None):
                carried = angle + 0.5 * (now + (now if before is None else before)) * elapsed
            else:
                carried = angle
            if position is None:
                self._angles[i] = carried
                continue
            if offset is None:
                offset = carried - position if elapsed else 0.0
                self._offsets = [*self._offsets[:i], offset, *self._offsets[i + 1 :]]
            self._angles[i] = offset + position
