"""How a robot comes up to a Ghost that stands: nearer, as near as it can, or no further.

The pose is measured with noise, so that no single one tells: what has been measured lately counts.
"""

from __future__ import annotations

from math import exp, hypot, inf

from agv_motion.planar import REST, Twist
from agv_motion.trajectory.tracking import TrackingError

NEARER = 0.9
"""[-] A share of the least distance so far; what is above it is no progress."""

AVERAGED = 1.0 / 3.0
"""[-] Time constant of the averages, as a share of the time without progress that is allowed."""


class Approach:
    """The errors and twists of lately, and how long there has been no progress."""

    def __init__(self) -> None:
        """Know nothing."""
        self.restart()

    def restart(self) -> None:
        """Forget: another approach begins."""
        self.stalled = 0.0
        """[s] since it came nearer"""
        self.error = TrackingError(0.0, 0.0, 0.0)
        """Average of lately"""
        self.twist = REST
        """Average of lately"""
        self._nearest = inf

    def update(
        self, error: TrackingError, separation: float, twist: Twist, dt: float, patience: float
    ) -> None:
        """Take up a cycle of ``dt`` [s].

        Args:
            error: The Ghost seen from the robot.
            separation: The same as one number [m].
            twist: Asked of the robot.
            dt: Since the last cycle.
            patience: Time without progress that is allowed [s].

        """
        first = self._nearest == inf
        if separation < NEARER * self._nearest:
            self._nearest, self.stalled = separation, 0.0
        else:
            self.stalled += dt
        tau = AVERAGED * patience
        share = 1.0 if first or tau <= 0.0 else 1.0 - exp(-dt / tau)
        self.error = TrackingError(
            *(a + share * (b - a) for a, b in zip(self.error, error, strict=True))
        )
        self.twist = Twist(*(a + share * (b - a) for a, b in zip(self.twist, twist, strict=True)))


def is_calm(twist: Twist, speed: float, turn: float) -> bool:
    """Return whether ``twist`` asks for no more than ``speed`` [m/s] and ``turn`` [rad/s]."""
    return hypot(twist.vx, twist.vy) <= speed and abs(twist.wz) <= turn
