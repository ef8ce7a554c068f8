"""Odometry of another, made ready for a fusion: in order, with a noise, its turns mended.

Which of its messages counts is decided by the one rule of `continuity`; the noise is the one it
tells, or one assumed from its way; and a gyroscope, where there is one, mends its turns.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.odometry.continuity import LEAP, Continuity, Succession
from agv_motion.odometry.covariance import CERTAIN, Covariance, shift
from agv_motion.odometry.gates import (
    MAX_DEVIATION,
    MAX_STAMP,
    MAX_WAY,
    ROUNDING,
    require_noise,
    require_within,
)
from agv_motion.odometry.gyro_odometry import GyroOdometry
from agv_motion.odometry.history import Waypoint
from agv_motion.planar import Pose, require_finite, wrap

if TYPE_CHECKING:
    from agv_motion.odometry.assumed_noise import AssumedNoise
    from agv_motion.odometry.fusion_parameters import FusionParameters
    from agv_motion.odometry.yaw_rate import YawRate

MOVED = Succession.MOVED
"""An attribute of an enumeration costs ten times a global: this one is read at every message."""
SLACK = 0.01, 0.05
"""[m, rad] What two messages may be apart however near their stamps are."""
MOST = MAX_DEVIATION**2
"""[m2, rad2] More noise is not added between two messages."""
SURE = 1.0 + ROUNDING
"""[-] Squared correlation that rounding may seem to leave."""
EXACT = 1e-13
"""[-] Share of a number that is lost in rounding, as differences of large ones are taken."""


class Passage(NamedTuple):
    """What became of one message of odometry."""

    step: Succession
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
        self._last: Waypoint | None = None

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
        order, last = self._order, self._last
        duration = stamp - order.stamp
        if last and 0.0 < duration <= LEAP and self._possible(last, now, duration):
            step = MOVED
            order.follow(stamp, now)
        else:
            _require(now)
            step = order.judge(stamp, now)
            if not step.used:
                return Passage(step, now)
        self._last = now
        if step is MOVED and self._noise is None and gyro is None:
            return Passage(step, now)
        leapt, begun = step in {Succession.LEAP, Succession.RESET}, None
        if leapt and self._order.begun is not None:
            begun = self._order.begun.value
        if self._noise is not None:
            if begun is not None and step is Succession.RESET:
                begun = begun._replace(noise=self._noise.restart(begun.pose))
            now = now._replace(noise=self._noise.follow(pose))
        if gyro is not None:
            now = self._turned(now, begun if step is Succession.RESET else None, gyro)
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
        x, y, theta = after.pose
        old_x, old_y, old_theta = before.pose
        return (
            -MAX_WAY <= x <= MAX_WAY
            and -MAX_WAY <= y <= MAX_WAY
            and hypot(x - old_x, y - old_y) <= self._max_speed * duration + way
            and abs(wrap(theta - old_theta)) <= self._max_turn_rate * duration + turn
            and (after.noise == before.noise or _has_grown(before.noise, after.noise, x, y))
        )


def _has_grown(before: Covariance, after: Covariance, x: float, y: float) -> bool:
    """Return whether noise was only added, as far as rounding lets one see, about ``(x, y)`` [m].

    `shift` and `is_noise`, written out: the hot path.
    """
    old_xx, old_xy, old_xt, old_yy, old_yt, old_tt = before
    new_xx, new_xy, new_xt, new_yy, new_yt, new_tt = after
    loss = EXACT * (1.0 + abs(new_xx) + abs(new_yy) + abs(new_tt))
    xt, yt, tt = new_xt - old_xt, new_yt - old_yt, new_tt - old_tt
    at_xt, at_yt = xt - y * tt, yt + x * tt
    xx = new_xx - old_xx - y * (xt + at_xt) + loss
    yy = new_yy - old_yy + x * (yt + at_yt) + loss
    xy = new_xy - old_xy + x * at_xt - y * yt
    tt += loss
    return (
        0.0 <= xx <= MOST
        and 0.0 <= yy <= MOST
        and 0.0 <= tt <= MOST
        and xy * xy <= SURE * xx * yy
        and at_xt * at_xt <= SURE * xx * tt
        and at_yt * at_yt <= SURE * yy * tt
    )


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
