"""Odometry of another, made ready for a fusion: in order, with a noise, its turns mended.

Which of its messages counts is decided by the one rule of `continuity`; the noise is the one it
tells, or one assumed from its way; and a gyroscope, where there is one, mends its turns.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.odometry.continuity import LEAP, Continuity, Step
from agv_motion.odometry.covariance import CERTAIN, Covariance, shift
from agv_motion.odometry.gates import MAX_STAMP, MAX_WAY, is_noise, require_noise, require_within
from agv_motion.odometry.gyro_odometry import GyroOdometry
from agv_motion.odometry.history import Waypoint
from agv_motion.planar import Pose, require_finite, wrap

if TYPE_CHECKING:
    from agv_motion.odometry.assumed_noise import AssumedNoise
    from agv_motion.odometry.fusion_parameters import FusionParameters
    from agv_motion.odometry.yaw_rate import YawRate

SLACK = 0.01, 0.05
"""[m, rad] What two messages may be apart however near their stamps are."""
EXACT = 1e-13
"""[-] Share of a number that is lost in rounding, as differences of large ones are taken."""


class Passage(NamedTuple):
    """What became of one message of odometry."""

    step: Step
    waypoint: Waypoint
    """Where it sees the robot"""
    begun: Waypoint | None = None
    """After a leap: from where on all is known again"""
    unseen: float = 0.0
    """[s] that may have passed with nothing seen"""


class OdometryIntake:
    """Takes messages of odometry one by one."""

    def __init__(self, parameters: FusionParameters, noise: AssumedNoise | None = None) -> None:
        """Wait for the first message.

        Args:
            parameters: How fast the robot is at most.
            noise: What to assume where odometry tells none of its own.

        """
        self._max_speed, self._max_turn_rate = parameters.max_speed, parameters.max_turn_rate
        self._noise = noise
        self._gyro_odometry: GyroOdometry | None = None
        self._order = Continuity[Waypoint](LEAP, self._possible)

    def take(
        self, stamp: float, pose: Pose, covariance: Covariance, gyro: YawRate | None = None
    ) -> Passage:
        """Take a message, and return what is to be made of it.

        Args:
            stamp: Time [s].
            pose: In `odom`.
            covariance: Of the error about the origin of `odom` since odometry began, see
                `dead_reckoning`; not looked at where it is assumed.
            gyro: What measures the turns better, if anything does.

        Raises:
            SignalError: A number is not finite, or beyond its gate; nothing has changed.

        """
        now = Waypoint(stamp, pose, CERTAIN if self._noise else covariance)
        _require(now)
        step = self._order.judge(stamp, now)
        if not step.used:
            return Passage(step, now)
        leapt, begun = step in {Step.LEAP, Step.RESET}, None
        if leapt and self._order.begun is not None:
            begun = self._order.begun.value
        if self._noise is not None:
            if begun is not None and step is Step.RESET:
                begun = begun._replace(noise=self._noise.restart(begun.pose))
            now = now._replace(noise=self._noise.follow(pose))
        if gyro is not None:
            now = self._turned(now, begun if step is Step.RESET else None, gyro)
        return Passage(step, now, begun, self._order.unseen if leapt else 0.0)

    def _turned(self, now: Waypoint, begun: Waypoint | None, gyro: YawRate) -> Waypoint:
        """Return ``now`` with the turns as the gyroscope measured them."""
        if self._gyro_odometry is None:
            self._gyro_odometry = GyroOdometry(now)
        else:
            if begun is not None:
                self._gyro_odometry.restart(begun)
            self._gyro_odometry.follow(now, gyro)
        own = self._gyro_odometry
        return Waypoint(now.stamp, own.pose, own.origin_covariance)

    def _possible(self, before: Waypoint, after: Waypoint, duration: float) -> bool:
        """Return whether the robot can have moved like that, and odometry only become less sure."""
        way, turn = SLACK
        old, new = before.pose, after.pose
        return (
            hypot(new.x - old.x, new.y - old.y) <= self._max_speed * duration + way
            and abs(wrap(new.theta - old.theta)) <= self._max_turn_rate * duration + turn
            and (after.noise == before.noise or _has_grown(before.noise, after))
        )


def _has_grown(before: Covariance, after: Waypoint) -> bool:
    """Return whether noise was only added since, as far as rounding lets one see."""
    added = Covariance(*[b - a for a, b in zip(before, after.noise, strict=True)])
    return is_noise(shift(added, after.pose.x, after.pose.y), _rounding(after.noise))


def _rounding(noise: Covariance) -> float:
    return EXACT * (1.0 + abs(noise.xx) + abs(noise.yy) + abs(noise.tt))


def _require(waypoint: Waypoint) -> None:
    """Raise unless it can be where odometry sees a robot."""
    stamp, (x, y, theta), noise = waypoint
    require_finite('odometry', (stamp, x, y, theta, *noise))
    require_within('stamp of odometry', (stamp,), MAX_STAMP, 's', 'look at its clock')
    require_within('odometry (x, y)', (x, y), MAX_WAY, 'm', 'let odometry begin anew at 0')
    if noise != CERTAIN:
        xx, xy, xt, yy, yt, tt = shift(noise, x, y)
        loss = _rounding(noise)
        require_noise('odometry', Covariance(xx + loss, xy, xt, yy + loss, yt, tt + loss))
