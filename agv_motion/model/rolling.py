"""Angles of wheels that roll on for months: they grow without end, and stay exact.

An angle is kept as whole turns and a rest within half a turn, so what is added is never small
beside what is there: after seven months (some million radians) the sum is right to 2e-9 rad, the
spacing of numbers of that size; plain adding would have lost far more. It is never wrapped: tools
take a leap back by a turn for a motion.
"""

from __future__ import annotations

from math import isfinite, tau
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

LONGEST_GAP = 1.0
"""[s] Silence over which nobody knows how far a wheel has rolled: it counts as rest."""


class WheelTurns:
    """The angles of n wheels, added up from 0."""

    def __init__(self, count: int) -> None:
        """Start at 0."""
        self._turns, self._rests = [0] * count, [0.0] * count

    def add(self, angles: Sequence[float]) -> None:
        """Turn each wheel on by one of (n,) ``angles`` [rad]; one that is not finite is left."""
        for i, angle in enumerate(angles):
            if isfinite(angle):
                rest = self._rests[i] + angle
                turns = round(rest / tau)
                self._turns[i] += turns
                self._rests[i] = rest - turns * tau

    def angles(self) -> list[float]:
        """Return (n,) angles since the start [rad], whole turns and all."""
        pairs = zip(self._turns, self._rests, strict=True)
        return [turns * tau + rest for turns, rest in pairs]


class CountedWheels:
    """Angles of n wheels whose drives tell angles, or rates alone.

    Drives that do not count turns tell no angles, or 0 for ever: then rates are added up over the
    time between two stamps, by the trapezoidal rule.
    """

    def __init__(self, count: int) -> None:
        """Wait for the first reading."""
        self._turns, self._count = WheelTurns(count), count
        self._counts = False
        """Whether the drives have told an angle that is not 0"""
        self._last: tuple[int, Sequence[float]] | None = None
        self._told: Sequence[float] = [0.0] * count

    def update(
        self, stamp: int, positions: Sequence[float], rates: Sequence[float]
    ) -> Sequence[float]:
        """Return (n,) angles [rad].

        Args:
            stamp: Of the reading [ns].
            positions: (n,) as told [rad]; or empty.
            rates: (n,) as told [rad/s]; or empty.

        """
        known = len(positions) == self._count and all(map(isfinite, positions))
        self._counts = self._counts or (known and any(positions))
        if self._counts:
            self._told = positions if known else self._told
        else:
            self._add(stamp, rates)
            self._told = self._turns.angles()
        return self._told

    def _add(self, stamp: int, rates: Sequence[float]) -> None:
        if len(rates) == self._count:
            if self._last is not None:
                before, last = self._last
                passed = (stamp - before) * 1e-9
                if 0.0 < passed <= LONGEST_GAP:
                    pairs = zip(last, rates, strict=True)
                    self._turns.add([0.5 * passed * (a + b) for a, b in pairs])
            self._last = stamp, tuple(rates)
