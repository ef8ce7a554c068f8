"""The last seconds of odometry, to say where the robot was when a fix was measured."""

from __future__ import annotations

from bisect import bisect_left
from math import hypot
from typing import NamedTuple

from agv_motion.odometry.covariance import Covariance
from agv_motion.planar import Pose, compose, integrate, inverse, logarithm, wrap


class Waypoint(NamedTuple):
    """Where odometry saw the base, and how uncertain it had become since it began."""

    stamp: float
    """[s]"""
    pose: Pose
    """In `odom`"""
    noise: Covariance
    """Of the error about the origin of `odom`: only its growth between two times is of use"""


class OdometryHistory:
    """Waypoints in the order of time, no older than a horizon."""

    def __init__(self, horizon: float) -> None:
        """Start empty.

        Args:
            horizon: How long a waypoint is kept [s].

        """
        self._horizon = horizon
        self._stamps: list[float] = []
        self._waypoints: list[Waypoint] = []

    def __bool__(self) -> bool:
        """Return whether there is a waypoint."""
        return bool(self._stamps)

    @property
    def newest(self) -> Waypoint:
        """The last waypoint."""
        return self._waypoints[-1]

    @property
    def oldest(self) -> Waypoint:
        """The first waypoint that is kept."""
        return self._waypoints[0]

    def last_two(self) -> list[Waypoint]:
        """Return the newest waypoint and, where there is one, the one before it."""
        return self._waypoints[-2:]

    def append(self, waypoint: Waypoint) -> None:
        """Keep a waypoint newer than all before; forget the old ones, many at a time."""
        self._stamps.append(waypoint.stamp)
        self._waypoints.append(waypoint)
        if len(self._stamps) % 256 == 0:
            kept = bisect_left(self._stamps, waypoint.stamp - self._horizon)
            del self._stamps[: max(kept - 1, 0)]  # one before the horizon, to interpolate from
            del self._waypoints[: max(kept - 1, 0)]

    def clear(self) -> None:
        """Forget all."""
        self._stamps.clear()
        self._waypoints.clear()

    def at(self, stamp: float) -> Waypoint:
        """Return where the base was at ``stamp``, between oldest and newest, along the arc."""
        after = bisect_left(self._stamps, stamp)
        later = self._waypoints[after]
        if later.stamp == stamp or after == 0:
            return later
        earlier = self._waypoints[after - 1]
        share = (stamp - earlier.stamp) / (later.stamp - earlier.stamp)
        twist = logarithm(compose(inverse(earlier.pose), later.pose))
        noise = [a + share * (b - a) for a, b in zip(earlier.noise, later.noise, strict=True)]
        return Waypoint(stamp, integrate(earlier.pose, twist, share), Covariance(*noise))


def speed_between(before: Waypoint, after: Waypoint) -> tuple[float, float]:
    """Return how fast the robot went [m/s] and turned [rad/s]; 0 where no time passed."""
    duration = after.stamp - before.stamp
    if duration <= 0.0:
        return 0.0, 0.0
    old, new = before.pose, after.pose
    way = hypot(new.x - old.x, new.y - old.y)
    return way / duration, abs(wrap(new.theta - old.theta)) / duration
