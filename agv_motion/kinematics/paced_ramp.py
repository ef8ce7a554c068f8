"""A ramp of the twist that goes on by the clock, however seldom or unevenly it is called."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from agv_motion.kinematics.twist_ramp import TwistRamp
    from agv_motion.planar import Twist


class PacedRamp:
    """A step of the ramp counts for no more than its period, or two.

    After a rest one period has passed, however long it was.
    """

    def __init__(self, ramp: TwistRamp, period: float) -> None:
        """Stand still.

        Args:
            ramp: Of the twist.
            period: Of the steps [s].

        """
        self.ramp = ramp
        self._period = period
        self._at, self._rested = -inf, True

    def stop(self) -> None:
        """Stand still at once, for safety."""
        self.ramp.stop()
        self._rested = True

    def advance(self, now: float) -> Twist:
        """Go on to the time ``now`` [s]; return the twist to command."""
        longest = self._period if self._rested else 2.0 * self._period
        twist = self.ramp.update(min(max(now - self._at, 0.0), longest))
        self._rested, self._at = self.ramp.settled, now
        return twist
