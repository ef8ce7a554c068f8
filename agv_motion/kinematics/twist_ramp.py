r"""A twist that follows what is asked for as fast as the wheels may speed up and brake.

The rim speeds are linear in the twist :math:`\xi`, so whatever lies on the straight line between
two twists needs of each wheel what lies between its two speeds. The twist goes along that line,

.. math:: \xi' = \xi + \lambda\,(\xi_t - \xi), \qquad
    \lambda = \min_i \frac{\Delta_i}{|s_i(\xi_t) - s_i(\xi)|}   \tag{1}

with :math:`\Delta_i` what wheel i may change by in the step: one factor for all, so a base that
speeds up from rest or brakes to rest stays on its arc. From forward to backward a wheel brakes as
hard as it may brake, and then speeds up as hard as it may speed up.

With a limit of jerk the change of the twist has a rate of its own, which goes over from what it is
to what (1) asks for, again by one factor for all, and falls in time to be zero at the target.
"""

from __future__ import annotations

from math import floor, inf, sqrt
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.planar import REST, THERE, Twist, require_twist

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.wheel_limits import WheelLimits


NOTHING = 1e-12
"""[m/s] A change of rim speed that is none."""


class TwistRamp:
    """The twist of one base; it holds the limits of the wheels at every update."""

    def __init__(self, rows: Sequence[Sequence[float]], limits: WheelLimits) -> None:
        """Stand still.

        Args:
            rows: (n,) rim speed [m/s] of each wheel for unit vx, vy and wz.
            limits: Of every wheel.

        """
        self._rows = [(float(a), float(b), float(c)) for a, b, c in rows]
        self._limits = limits
        self.twist = REST
        """what is to be commanded now"""
        self.target = REST
        """what it will be, within the limit of speed"""
        self._slope = REST  # of the twist [per s]; kept for the limit of jerk alone

    @property
    def settled(self) -> bool:
        """Whether the target is reached, and nothing changes until there is another."""
        return self.twist == self.target

    def stop(self) -> None:
        """Stand still at once, whatever the limits: for safety, where a ramp would be time lost."""
        self.twist = self.target = self._slope = REST

    def set_target(self, twist: Twist) -> None:
        """Aim at ``twist``; where a wheel would be too fast for it, at a scaled one.

        Raises:
            SignalError: A number is not finite, or beyond any robot.

        """
        require_twist(twist)
        self.target = self._slowed(twist)

    def update(self, dt: float) -> Twist:
        """Let ``dt`` [s] pass; return the twist to command.

        Raises:
            SignalError: ``dt`` is negative or not finite.

        """
        if not 0.0 <= dt < inf:
            msg = f'dt = {dt} s: give a finite time of 0 or more'
            raise SignalError(msg)
        if self.twist == self.target or dt == 0.0:
            self._slope = REST if dt else self._slope
        elif self._limits.jerk == inf:
            self._approach(dt)
        else:
            self._ease(dt)
        return self.twist

    def fastest(self, twist: Twist) -> float:
        """Return the speed of the fastest rim with ``twist`` [m/s]."""
        return max(abs(_speed(row, twist)) for row in self._rows)

    def _approach(self, dt: float) -> None:
        """Go along equation (1)."""
        gap, share = _minus(self.target, self.twist), 1.0
        for row in self._rows:
            change = _speed(row, gap)
            if change != 0.0:
                share = min(share, self._allowed(_speed(row, self.twist), change, dt) / abs(change))
        self.twist = self.target if share >= THERE else _plus(self.twist, share, gap)

    def _allowed(self, speed: float, change: float, dt: float) -> float:
        """Return by how much a wheel at ``speed`` may change in ``dt`` towards ``change``."""
        if speed * change >= 0.0:
            return self._limits.speeding_up * dt
        speed = abs(speed)
        if speed >= self._limits.braking * dt:
            return self._limits.braking * dt
        return speed + self._limits.speeding_up * (dt - speed / self._limits.braking)

    def _ease(self, dt: float) -> None:
        """Change the slope by the jerk, and the twist by the slope."""
        gap, slope = _minus(self.target, self.twist), self._slope
        changes = [_speed(row, gap) for row in self._rows]
        most = max(map(abs, changes))
        # of the share of the gap [1/s]; a gap of rounding is closed in this step
        rate = _landing_rate(most, self._limits.jerk, dt) / most if most > NOTHING else 1.0 / dt
        for row, change in zip(self._rows, changes, strict=True):
            speed = _speed(row, self.twist)
            brakes = speed * change < 0.0 and abs(change) <= abs(speed)
            limit = self._limits.braking if brakes else self._limits.speeding_up
            if abs(change) * rate > limit:
                rate = limit / abs(change)
        wanted = Twist(rate * gap.vx, rate * gap.vy, rate * gap.wz)
        turn = _minus(wanted, slope)
        hardest = max(abs(_speed(row, turn)) for row in self._rows)
        if hardest <= self._limits.jerk * dt:
            self._slope = wanted
            there = rate * dt >= THERE
            self.twist = self.target if there else _plus(self.twist, rate * dt, gap)
            return
        self._slope = slope = _plus(slope, self._limits.jerk * dt / hardest, turn)
        self.twist = self._slowed(_plus(self.twist, dt, slope))

    def _slowed(self, twist: Twist) -> Twist:
        """Return ``twist``, all of it slower by one factor where a wheel would be too fast."""
        fastest = self.fastest(twist)
        if fastest <= self._limits.max_wheel_speed:
            return twist
        scale = self._limits.max_wheel_speed / fastest
        return Twist(scale * twist.vx, scale * twist.vy, scale * twist.wz)


def _landing_rate(distance: float, braking: float, dt: float) -> float:
    """Return the highest rate over the next step from which a stop at ``distance`` is possible.

    Rates are constant over a step and fall by ``braking * dt`` from one to the next at most: m more
    steps follow, and the first is such that all together end at ``distance`` exactly.
    """
    fall = braking * dt
    m = floor(0.5 * (sqrt(1.0 + 8.0 * distance / (dt * fall)) - 1.0))
    return (distance / dt + 0.5 * fall * m * (m + 1)) / (m + 1)


def _speed(row: Sequence[float], twist: Twist) -> float:
    return row[0] * twist[0] + row[1] * twist[1] + row[2] * twist[2]


def _minus(first: Twist, second: Twist) -> Twist:
    return Twist(first[0] - second[0], first[1] - second[1], first[2] - second[2])


def _plus(first: Twist, share: float, second: Twist) -> Twist:
    return Twist(
        first[0] + share * second[0], first[1] + share * second[1], first[2] + share * second[2]
    )
