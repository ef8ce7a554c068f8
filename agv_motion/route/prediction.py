"""What would happen: an ideal robot, that does at once what it is told, on a route."""

from __future__ import annotations

from collections import Counter
from math import hypot
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from agv_motion.planar import REST, Pose, integrate
from agv_motion.route.follower import RouteFollower, RouteStep

if TYPE_CHECKING:
    from agv_motion.route.parameters import FollowParameters
    from agv_motion.route.route import Route
    from agv_motion.twist_limits import TwistLimits

NOTHING = 'nothing'
"""What holds the speed down where the robot goes as fast as the tables ever allow."""


class Prediction(NamedTuple):
    """The run of an ideal robot, one element a step."""

    dt: float
    """[s] between two steps"""
    poses: list[Pose]
    """where it is at each"""
    steps: list[RouteStep]
    """what the follower says there; the last one is the arrival, if it arrives"""
    top_speed: float
    """[m/s] that the tables allow at all"""

    @property
    def arrived(self) -> bool:
        """Whether it reaches the end within the time."""
        return self.steps[-1].arrived

    @property
    def duration(self) -> float:
        """Until arrival, or until the time is over [s]."""
        return self.dt * (len(self.steps) - 1)

    def held_by(self) -> list[str]:
        """Return for each step what holds the speed down, :data:`NOTHING` at top speed."""
        return [
            NOTHING if hypot(*step.twist[:2]) >= self.top_speed else step.limits.limiter.value
            for step in self.steps
        ]

    def limiter_shares(self) -> dict[str, float]:
        """Return for which share of the time what holds the speed down, most frequent first."""
        counts = Counter(self.held_by())
        return {name: count / len(self.steps) for name, count in counts.most_common()}

    def cross_track(self, route: Route) -> tuple[float, float]:
        """Return root mean square and maximum of the distance from ``route`` [m]."""
        line = shapely.linestrings(route.waypoints)
        off = shapely.distance(shapely.points([(x, y) for x, y, _ in self.poses]), line)
        return float(np.sqrt(np.mean(off**2))), float(np.max(off))


def predict(  # noqa: PLR0913 - all but three have a default
    route: Route,
    parameters: FollowParameters,
    start: Pose,
    dt: float = 0.05,
    longest: float = 3600.0,
    *,
    limits: TwistLimits | None = None,
) -> Prediction:
    """Return the run of an ideal robot from ``start``.

    Args:
        route: What it follows.
        parameters: How.
        start: Where it stands at first.
        dt: Time between two commands [s].
        longest: Time after which to give up [s].
        limits: What its commands are held within, beside the tables.

    Raises:
        ConfigurationError: The distance of the virtual point is too large for the route.

    """
    follower = RouteFollower(route, parameters)

    def step(pose: Pose, passed: float) -> RouteStep:
        found = follower.step(pose, passed)
        return found if limits is None else found._replace(twist=limits.hold(found.twist))

    poses, steps = [start], [step(start, 0.0)]
    while not steps[-1].arrived and (len(steps) - 1) * dt < longest:
        twist = steps[-1].twist
        poses.append(integrate(poses[-1], twist, dt) if twist != REST else poses[-1])
        steps.append(step(poses[-1], dt))
    return Prediction(dt, poses, steps, parameters.profiles().top_speed())
