"""One number that follows another as fast as a rate and a jerk allow, whatever the time step.

The move is the time-optimal one from the present value and slope to the wanted value at rest:
the slope climbs by the jerk to a peak (at most the rate), holds, and falls back to zero. It is
worked out in closed form and sampled, so two half steps are one whole step.

Source: L. Biagiotti, C. Melchiorri, "Trajectory Planning for Automatic Machines and Robots",
Springer 2008, section 3.4 (here for a speed in the place of a position).
"""

from __future__ import annotations

from math import copysign, inf, sqrt

from agv_motion.errors import SignalError


class Ramp:
    """Holds the value and its slope between two steps."""

    def __init__(self, rate: float = inf, jerk: float = inf, value: float = 0.0) -> None:
        """Start at rest.

        Args:
            rate: Largest slope [1/s]; infinite: none.
            jerk: Largest change of slope [1/s2]; infinite: none.
            value: Where to start.

        """
        self.rate, self.jerk = rate, jerk
        self.value = value
        self.slope = 0.0

    def set(self, value: float) -> None:
        """Jump: be at ``value``, at rest."""
        self.value, self.slope = value, 0.0

    def advance(self, target: float, dt: float) -> float:
        """Move towards ``target`` for ``dt`` [s] and return the new value.

        Raises:
            SignalError: ``dt`` is negative or not finite.

        """
        if not 0.0 <= dt < inf:
            msg = f'time step {dt} s: must be zero or more and finite'
            raise SignalError(msg)
        if self.rate == inf:
            self.set(target)
        elif self.jerk == inf:
            step = target - self.value
            most = self.rate * dt
            self.set(target if abs(step) <= most else self.value + copysign(most, step))
        else:
            self._follow(target, dt)
        return self.value

    def _follow(self, target: float, dt: float) -> None:
        """Go through the three phases of the move for ``dt`` [s].

        In the direction of the move: from slope s to the peak p and back to zero the value changes
        by ((p^2 - s^2) + p^2) / 2j; ``gap`` is what remains when the slope is first led to zero.
        """
        rate, jerk = self.rate, self.jerk
        slope = min(max(self.slope, -rate), rate)
        gap = target - self.value - slope * abs(slope) / (2.0 * jerk)
        up = copysign(1.0, gap)
        slope *= up
        peak, hold = sqrt(jerk * abs(gap) + max(slope, 0.0) ** 2), 0.0
        if peak > rate:
            change = up * (target - self.value)
            peak, hold = rate, (change - (2.0 * rate**2 - slope**2) / (2.0 * jerk)) / rate
        moved = 0.0
        for duration, turn in (((peak - slope) / jerk, jerk), (hold, 0.0), (peak / jerk, -jerk)):
            t = min(duration, dt)
            moved += slope * t + 0.5 * turn * t * t
            slope += turn * t
            dt -= t
        self.value += up * moved
        self.slope = up * slope
        if dt > 0.0:
            self.set(target)
