"""Angles from motors that tell their rates only: what they turned, by the trapezoidal rule."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.odometry.encoders import CLOCK_SET_BACK

if TYPE_CHECKING:
    from collections.abc import Sequence


class RateEncoder:
    """Adds up measured rates of wheels, as an encoder would count."""

    def __init__(self, count: int) -> None:
        """Start all ``count`` wheels at 0."""
        self._angles: list[float | None] = [0.0] * count
        self._rates: Sequence[float | None] = [None] * count
        self._stamp: float | None = None

    def add(self, stamp: float, rates: Sequence[float | None]) -> list[float | None]:
        """Return (n,) angles [rad] at ``stamp`` [s]; None for a wheel whose rate is not known.

        Over the step in which a wheel falls silent or comes back its angle stands still: such a
        step has to be done without it. A stamp that is not newer adds nothing.
        """
        elapsed = 0.0 if self._stamp is None else stamp - self._stamp
        if elapsed > 0.0:
            self._angles = [
                angle if now is None or last is None or angle is None
                else angle + 0.5 * (now + last) * elapsed
                for angle, now, last in zip(self._angles, rates, self._rates, strict=True)
            ]  # fmt: skip
        if elapsed > 0.0 or elapsed <= -CLOCK_SET_BACK or self._stamp is None:
            self._stamp, self._rates = stamp, list(rates)
        return [
            None if rate is None else angle for angle, rate in zip(self._angles, rates, strict=True)
        ]
