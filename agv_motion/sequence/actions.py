"""What a robot can be told to do, as people write it: metres, seconds, degrees.

Each action is a row of a sequence file; its fields are the keys there.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, pi, radians
from typing import TYPE_CHECKING, Annotated, Protocol

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose, wrap

if TYPE_CHECKING:
    from agv_motion.route.route import Route
    from agv_motion.trajectory.ghost import Ghost
    from agv_motion.trajectory.trajectory import Trajectory

ANYWHERE = (-1e5, 1e5)


class GhostAction(Protocol):
    """An action that a Ghost performs before the robot."""

    def plan(self, ghost: Ghost) -> Trajectory:
        """Send ``ghost`` on its way from where it is."""

    def plan_again(self, ghost: Ghost, end: Pose) -> Trajectory:
        """Send ``ghost`` from wherever it is to the same ``end``, after a failure."""


@dataclass(frozen=True)
class GoTo:
    """Drive to a pose."""

    x: Annotated[float, Spec('where to go', 'm', ANYWHERE)]
    y: Annotated[float, Spec('where to go', 'm', ANYWHERE)]
    heading: Annotated[
        float | None,
        Spec('where to look there; without it: straight there, turning on the spot first', 'deg',
             (-360.0, 360.0)),
    ] = None  # fmt: skip
    curve: Annotated[
        float,
        Spec('handles of the curve as a share of the distance; 0: straight, turns at both ends',
             '1', (0.0, 5.0)),
    ] = 0.4  # fmt: skip
    speed: Annotated[float, Spec('cruising speed', 'm/s', (0.001, 10.0))] = 0.4
    acceleration: Annotated[
        float, Spec('speeding up and braking; 0: no ramp', 'm/s2', (0.0, 10.0))
    ] = 0.3
    backward: Annotated[bool, Spec('drive backwards')] = False

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def plan(self, ghost: Ghost) -> Trajectory:
        """Send ``ghost`` there."""
        goal, curve = Pose(self.x, self.y, 0.0), self.curve
        if self.heading is None:
            here = ghost.pose
            line = atan2(self.y - here.y, self.x - here.x)
            there = (here.x, here.y) == (self.x, self.y)
            heading, curve = (here.theta if there else line + pi * self.backward), 0.0
        else:
            heading = radians(self.heading)
        return ghost.compute_trajectory(
            goal._replace(theta=wrap(heading)),
            curve, self.acceleration, self.speed, backward=self.backward,
        )  # fmt: skip

    def plan_again(self, ghost: Ghost, end: Pose) -> Trajectory:
        """Send ``ghost`` there once more."""
        curve = 0.0 if self.heading is None else self.curve
        return ghost.compute_trajectory(
            end, curve, self.acceleration, self.speed, backward=self.backward
        )


@dataclass(frozen=True)
class Rotate:
    """Turn on the spot, by an angle or to a heading."""

    by: Annotated[
        float | None, Spec('angle to turn, left positive, of any size', 'deg', (-36000.0, 36000.0))
    ] = None
    to: Annotated[
        float | None, Spec('heading to turn to, the shorter way round', 'deg', (-360.0, 360.0))
    ] = None
    speed: Annotated[float, Spec('fastest turn', 'deg/s', (0.1, 720.0))] = 45.0
    acceleration: Annotated[
        float, Spec('ramps of the turn; 0: no ramp', 'deg/s2', (0.0, 3600.0))
    ] = 60.0

    def __post_init__(self) -> None:
        """Check every row, and that there is one goal."""
        check(self)
        if (self.by is None) == (self.to is None):
            msg = f'by = {self.by}, to = {self.to}: give one of the two'
            raise ConfigurationError(msg)

    def plan(self, ghost: Ghost) -> Trajectory:
        """Turn ``ghost``."""
        pace = radians(self.acceleration), radians(self.speed)
        if self.by is not None:
            return ghost.compute_turn(radians(self.by), *pace)
        goal = ghost.pose._replace(theta=wrap(radians(self.to or 0.0)))
        return ghost.compute_trajectory(goal, 0.0, *pace, pure_rotation=True)

    def plan_again(self, ghost: Ghost, end: Pose) -> Trajectory:
        """Turn ``ghost`` to the heading of ``end``, the shorter way round."""
        pace = radians(self.acceleration), radians(self.speed)
        return ghost.compute_trajectory(end, 0.0, *pace, pure_rotation=True)


@dataclass(frozen=True)
class DriveArc:
    """Drive along a circle."""

    angle: Annotated[
        float, Spec('of the arc: positive has the centre on the left, negative on the right', 'deg',
                    (-36000.0, 36000.0))
    ]  # fmt: skip
    diameter: Annotated[
        float, Spec("of the inner wheel's circle; 0: pivot on that wheel", 'm', (0.0, 1e4))
    ]
    speed: Annotated[float, Spec('of the outer wheel', 'm/s', (0.001, 10.0))] = 0.4
    acceleration: Annotated[float, Spec('of the outer wheel; 0: no ramp', 'm/s2', (0.0, 10.0))] = (
        0.3
    )
    backward: Annotated[bool, Spec('drive backwards')] = False

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def plan(self, ghost: Ghost) -> Trajectory:
        """Send ``ghost`` along the circle."""
        speed = -self.speed if self.backward else self.speed
        return ghost.compute_arc(radians(self.angle), self.diameter, self.acceleration, speed)

    def plan_again(self, ghost: Ghost, end: Pose) -> Trajectory:
        """Send ``ghost`` straight to ``end``, turning on the spot before and after."""
        return ghost.compute_trajectory(
            end, 0.0, self.acceleration, self.speed, backward=self.backward
        )


@dataclass(frozen=True)
class FollowRoute:
    """Follow a route with a virtual point."""

    route: Route


@dataclass(frozen=True)
class Wait:
    """Stand still."""

    seconds: Annotated[float, Spec('how long', 's', (0.0, 1e6))]

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


Action = GoTo | Rotate | DriveArc | FollowRoute | Wait
