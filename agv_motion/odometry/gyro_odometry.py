"""Odometry of another, corrected by a gyroscope on the way: its steps, with a better turn in each.

The wheels are no longer at hand, only the poses they led to; a step is what lies between two of
them, and its noise what was added meanwhile (see `dead_reckoning`), seen from the base.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.odometry.covariance import Covariance, rotate, shift
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.planar import Pose, compose, inverse, logarithm

if TYPE_CHECKING:
    from agv_motion.odometry.history import Waypoint
    from agv_motion.odometry.yaw_rate import YawRate


class GyroOdometry:
    """Follows waypoints of odometry; starts where the first of them is."""

    def __init__(self, first: Waypoint) -> None:
        """Start at ``first``, with its uncertainty."""
        self._reckoning = DeadReckoning()
        self.restart(first)

    @property
    def pose(self) -> Pose:
        """Pose of the base in `odom`."""
        return self._reckoning.pose

    @property
    def origin_covariance(self) -> Covariance:
        """Covariance of the error about the origin of `odom`."""
        return self._reckoning.origin_covariance

    def restart(self, waypoint: Waypoint) -> None:
        """Begin anew at ``waypoint``, with its uncertainty, where odometry does."""
        self._last = waypoint
        x, y = waypoint.pose.x, waypoint.pose.y
        self._reckoning.set(waypoint.pose, shift(waypoint.noise, x, y))

    def follow(self, waypoint: Waypoint, gyro: YawRate) -> None:
        """Take the step from the last waypoint to one that goes on from it, see `continuity`.

        Args:
            waypoint: Where odometry sees the base now; its stamp may have leapt.
            gyro: The gyroscope, which is asked for the turn since, and learns from the wheels.

        """
        last, self._last = self._last, waypoint
        turn = gyro.take()
        duration = waypoint.stamp - last.stamp
        step = logarithm(compose(inverse(last.pose), waypoint.pose))
        added = Covariance(*[b - a for a, b in zip(last.noise, waypoint.noise, strict=True)])
        x, y = 0.5 * (last.pose.x + waypoint.pose.x), 0.5 * (last.pose.y + waypoint.pose.y)
        covariance = rotate(shift(added, x, y), -(last.pose.theta + 0.5 * step.wz))
        displacement: tuple[float, float, float] = step
        if turn is not None and covariance.tt > 0.0 and turn.fits(duration):
            share = turn.duration / duration
            gyro.compare(turn, share * step.wz, share * covariance.tt)
            displacement, covariance = turn.correct(displacement, covariance, duration)
        self._reckoning.carry(displacement, covariance)
