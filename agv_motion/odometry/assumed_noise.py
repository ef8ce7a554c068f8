"""A covariance for odometry that tells none of its own: a random walk with distance and turn."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Annotated

from agv_motion.odometry.covariance import Covariance, shift
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose, compose, inverse, logarithm, require_finite


@dataclass(frozen=True)
class AssumedNoiseParameters:
    """How far a stranger's odometry can be trusted."""

    position: Annotated[
        float, Spec('standard deviation of the position after 1 m', 'm', (1e-6, 1.0))
    ] = 0.02
    heading: Annotated[
        float, Spec('standard deviation of the heading after 1 m', 'rad', (1e-6, 1.0))
    ] = 0.02
    turning: Annotated[
        float, Spec('standard deviation of the heading after 1 rad', 'rad', (1e-6, 1.0))
    ] = 0.02

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class AssumedNoise:
    """Follows poses and adds up what noise they probably bear."""

    def __init__(self, parameters: AssumedNoiseParameters | None = None) -> None:
        """Start with certainty at the first pose."""
        self._given = parameters or AssumedNoiseParameters()
        self._reckoning = DeadReckoning()
        self._last: Pose | None = None

    def follow(self, pose: Pose) -> Covariance:
        """Return the covariance of the error about the origin of `odom` up to ``pose``.

        Raises:
            SignalError: A number is not finite.

        """
        require_finite('pose', pose)
        if self._last is None:
            self._reckoning.set(pose)
        elif pose != self._last:
            given = self._given
            step = logarithm(compose(inverse(self._last), pose))
            way = hypot(step.vx, step.vy)
            along = given.position**2 * way
            turned = given.heading**2 * way + given.turning**2 * abs(step.wz)
            self._reckoning.carry(step, Covariance(along, 0.0, 0.0, along, 0.0, turned))
        self._last = pose
        return self._reckoning.origin_covariance

    def restart(self, pose: Pose) -> Covariance:
        """Go on from ``pose``, to which no way led; return the covariance, which is as it was.

        Raises:
            SignalError: A number is not finite.

        """
        require_finite('pose', pose)
        if self._last is None:
            return self.follow(pose)
        about_origin = self._reckoning.origin_covariance
        self._reckoning.set(pose, shift(about_origin, pose.x, pose.y))
        self._last = pose
        return self._reckoning.origin_covariance
