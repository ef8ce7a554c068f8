"""An arc wheel by wheel, for a controller that knows no pose: speeds to hold, cycle by cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import SignalError
from agv_motion.kinematics.differential import WheelSpeeds
from agv_motion.trajectory.speed_plan import plan_speed

if TYPE_CHECKING:
    from agv_motion.trajectory.arc import Arc

SMALLEST = 1e-12
"""[m] An arc of less is done at once."""


class ArcRun:
    """The wheels along an arc, cycle by cycle, for a controller that holds speeds over a cycle.

    Each cycle gets its *mean* speeds, so that wheels that hold them end exactly at the end of the
    arc, whatever the lengths of the cycles; sampled speeds would end up to one cycle off.
    """

    def __init__(self, arc: Arc, rounding: float = 0.0) -> None:
        """Stand at the start of ``arc``.

        Args:
            arc: What to drive.
            rounding: Time over which acceleration builds up [s]; 0 for trapezoids.

        """
        self.arc = arc
        self._time = 0.0
        self._outer = 0.0
        self._distance = arc.outer_distance if arc.outer_distance > SMALLEST else 0.0
        self.duration = 0.0
        """[s]"""
        if self._distance > 0.0:
            nodes, cruise = np.array([0.0, self._distance]), np.full(2, abs(arc.speed))
            self._profile = plan_speed(nodes, cruise, arc.acceleration, rounding=rounding)
            self.duration = self._profile.duration

    @property
    def finished(self) -> bool:
        """Whether the wheels have been told all the way."""
        return self._time >= self.duration

    @property
    def travel(self) -> WheelSpeeds:
        """What the wheels have been told so far [m]."""
        return self.arc.wheels(self._outer)

    def advance(self, dt: float) -> WheelSpeeds:
        """Return the rim speeds to hold for the next ``dt`` [s]; zeros when it is done.

        Raises:
            SignalError: ``dt`` is not finite and above 0.

        """
        if not 0.0 < dt < float('inf'):
            msg = f'dt = {dt} s: give a finite time above 0'
            raise SignalError(msg)
        if self.finished:
            return WheelSpeeds(0.0, 0.0)
        self._time += dt
        outer = self._distance if self.finished else self._profile.at(self._time).way
        moved, self._outer = outer - self._outer, outer
        return self.arc.wheels(moved / dt)
