"""The last stretch of an old trajectory, braked, before a new one departs from it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.trajectory.motion import STILL, Speeds

if TYPE_CHECKING:
    from agv_motion.planar import Pose
    from agv_motion.trajectory.trajectory import Trajectory


class Braking:
    """A stopped trajectory from a time on, for a while; a motion that may end in motion."""

    def __init__(self, stopped: Trajectory, begin: float, rate: float, duration: float) -> None:
        """Follow ``stopped`` for ``duration`` [s].

        Args:
            stopped: A trajectory that brakes from ``begin`` on until it rests.
            begin: Its time at which this motion starts [s].
            rate: Share of time that passes for it.
            duration: How long to follow it [s].

        """
        self._stopped = stopped
        self._begin = begin
        self._rate = rate
        self.duration = duration
        self.end = self.pose(duration)
        self.end_speeds = self._at(duration)

    @property
    def rotating(self) -> bool:
        """Whether it turns on the spot."""
        return self._stopped.rotating(self._begin)

    @property
    def length(self) -> float:
        """Way driven [m]."""
        mean = 0.5 * (abs(self._at(0.0).linear) + abs(self.end_speeds.linear))
        return mean * self.duration

    def pose(self, time: float) -> Pose:
        """Return the pose at ``time`` [s]."""
        time = min(max(time, 0.0), self.duration)
        return self._stopped.pose(self._begin + self._rate * time)

    def speeds(self, time: float) -> Speeds:
        """Return the speeds at ``time`` [s]."""
        return self._at(time) if 0.0 <= time < self.duration else STILL

    def stopped(self, time: float) -> Braking:
        """Return this motion until it rests: it brakes already."""
        left = (self._stopped.duration - self._begin) / self._rate
        return Braking(self._stopped, self._begin, self._rate, max(left, time))

    def _at(self, time: float) -> Speeds:
        linear, angular = self._stopped.speeds(self._begin + self._rate * time)
        return Speeds(self._rate * linear, self._rate * angular)
