"""One angle a wheel from whatever its motor tells: a position, a rate, or now one, now the other.

What two positions tell of the way between them is kept; where there are only rates they are added
up by the trapezoidal rule, over the time that has passed by the one rule of `continuity`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.odometry.continuity import Continuity, Succession
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
        self._order = Continuity[list[float | None]](max_gap, lambda *_: True)
        self._max_rate = max_rate
        self._angles = [0.0] * count
        self._offsets = list(self._none)
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
        positions, rates = positions or self._none, list(rates or self._none)
        for i, (position, rate) in enumerate(zip(positions, rates, strict=True)):
            if rate is not None and not abs(rate) <= self._max_rate:
                if position is None:
                    require_within('wheel rates', (rate,), self._max_rate, 'rad/s', 'mend them')
                rates[i] = None
        pairs = list(zip(positions, rates, strict=True))
        self.by_rate = any(position is None and rate is not None for position, rate in pairs)
        before, last = self._order.stamp, self._order.last
        step = self._order.judge(stamp, rates)
        if step.used:
            if step is Succession.LEAP and self._order.begun is not None:
                before, last = self._order.begun.stamp, self._order.begun
            elapsed = 0.0 if step is Succession.FIRST else stamp - before
            self._count(pairs, self._none if last is None else last.value, elapsed)
        return [
            None if position is None and rate is None else angle
            for (position, rate), angle in zip(pairs, self._angles, strict=True)
        ]

    def _count(
        self,
        pairs: Sequence[tuple[float | None, float | None]],
        last: Sequence[float | None],
        elapsed: float,
    ) -> None:
        """Carry each angle on over ``elapsed`` [s], with the rates now and those before."""
        for i, ((position, now), before) in enumerate(zip(pairs, last, strict=True)):
            offset = self._offsets[i]
            if position is not None and offset is not None:
                self._angles[i] = offset + position
                continue
            known = [rate for rate in (now, before) if rate is not None]
            if known and (position is not None or offset is not None or len(known) == 2):
                self._angles[i] += sum(known) / len(known) * elapsed
            if position is not None:  # for the first time: it may stand anywhere
                offset = self._angles[i] - position if elapsed else 0.0
                self._offsets[i], self._angles[i] = offset, offset + position
