"""What a fusion goes on believing when the clock leaps, or odometry jumps to another origin."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.odometry.alignment import UNKNOWN
from agv_motion.odometry.belief import Belief, Drift, covariance_at
from agv_motion.odometry.continuity import LEAP, Succession
from agv_motion.odometry.covariance import Covariance, add, rotate, shift
from agv_motion.odometry.history import Waypoint, speed_between
from agv_motion.planar import compose, inverse

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.odometry_intake import Passage


class Leap:
    """From the last waypoints before a leap to the first after it."""

    def __init__(self, before: Sequence[Waypoint], passage: Passage) -> None:
        """Look at both sides.

        Args:
            before: The last one or two waypoints before the leap.
            passage: The message of odometry by which the leap was believed.

        """
        self._last, self._passage = before[-1], passage
        self._first = passage.begun or passage.waypoint
        self._speeds = [
            speed_between(before[0], before[-1]),
            speed_between(self._first, passage.waypoint),
        ]
        self.of_clock = not 0.0 < self._first.stamp - self._last.stamp <= LEAP
        """Whether the stamps leapt"""
        self.of_all = self.of_clock and passage.step is Succession.RESET
        """Whether stamps and poses leapt: then all began anew"""

    def keep(self, belief: Belief, drift: Drift) -> Belief:
        """Return the belief afterwards: the robot is where it was, but for what was not seen."""
        last, first = self._last, self._first
        about_robot = add(covariance_at(belief, last, drift), self._lost())
        covariance = shift(about_robot, -last.pose.x, -last.pose.y)
        if self._passage.step is not Succession.RESET:
            return Belief(belief.map_to_odom, covariance, last._replace(stamp=first.stamp))
        jump = compose(last.pose, inverse(first.pose))
        moved = rotate(shift(covariance, jump.x, jump.y), -jump.theta)
        return Belief(compose(belief.map_to_odom, jump), moved, first)

    def _lost(self) -> Covariance:
        """Return the covariance of what the robot may have done with nothing seen of it."""
        way, turn = (max(pair) * self._passage.unseen for pair in zip(*self._speeds, strict=True))
        return Covariance(way * way, 0.0, 0.0, way * way, 0.0, min(turn * turn, UNKNOWN))
