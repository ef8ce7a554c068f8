"""What turrets tell of their platform: how it moves, how hard they fight, and where it is."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.odometry.base import TurretBase
from agv_motion.odometry.continuity import Continuity, Succession
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.odometry.gates import require_within
from agv_motion.planar import Twist

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.kinematics.turrets import Turrets
    from agv_motion.odometry.covariance import Covariance
    from agv_motion.planar import Pose

    Column = NDArray[np.float64]

MAX_GAP = 0.5
"""[s] Silence beyond which nobody knows whether the wheels rolled on."""
EVEN = 0.25
"""[s] A step that is longer counts as less sure, where the motion changed meanwhile."""
MAX_WHEEL_SPEED = 10.0
"""[m/s] No wheel of a platform on turrets rolls faster."""


class Reckoned(NamedTuple):
    """What is known after one state of the turrets."""

    twist: Twist
    residual: float
    """[m/s] how hard the turrets pull against each other"""
    pose: Pose
    """where the wheels carried the platform"""
    covariance: Covariance
    """of the pose"""
    step: Succession
    """what the state was good for; one that is ignored leaves pose and covariance"""


class ReckonedColumns(NamedTuple):
    """The same after each of many states; every number is a column (n,)."""

    twist: tuple[Column, Column, Column]
    residual: Column
    pose: tuple[Column, Column, Column]
    covariance: Covariance


class TurretOdometry:
    """Takes states of the turrets, one by one or many together: to the bit the same."""

    def __init__(
        self,
        turrets: Turrets,
        noise: float,
        max_wheel_speed: float = MAX_WHEEL_SPEED,
        max_gap: float = MAX_GAP,
    ) -> None:
        """Start at the origin, with certainty.

        Args:
            turrets: The platform.
            noise: Standard deviation of the travel of a wheel after 1 m [m].
            max_wheel_speed: Beyond, a measured speed cannot be [m/s].
            max_gap: Silence beyond which nobody knows whether the wheels rolled on [s].

        """
        self._base, self._noise = TurretBase(turrets), noise
        self._max_speed, self._max_gap = max_wheel_speed, max_gap
        self._reckoning = DeadReckoning()
        self._order = Continuity[tuple[float, Twist]](max_gap, lambda *_: True)
        self._rolled: Sequence[float] = ()

    def update(
        self,
        time: float,
        angles: Sequence[float],
        speeds: Sequence[float],
        rolled: Sequence[float] = (),
    ) -> Reckoned:
        """Take one state; where it does not follow the last one, the pose stays.

        Args:
            time: Of the state [s].
            angles: (k,) steering angles [rad].
            speeds: (k,) rolling speeds along them [m/s]; empty where only ``rolled`` is known.
            rolled: (k,) how far each wheel has rolled in all [m]; empty where nobody counts.

        Raises:
            SignalError: A wrong number of values, one that is not finite, or a speed that cannot
                be; nothing has changed.

        """
        if not speeds:
            speeds = self._speeds(time, rolled)
        fit = self._base.turrets.twist(angles, speeds)
        require_within('wheel speeds', speeds, self._max_speed, 'm/s', 'look at the encoders')
        before, order = self._order.last, self._order
        speed = sum(map(abs, speeds)) / len(speeds)
        step = order.judge(time, (speed, fit.twist))
        if step.used and before is not None:
            begun = order.begun if step is Succession.LEAP and order.begun is not None else before
            passed, (last_speed, last_twist) = time - begun.stamp, before.value
            # over a gap they either rolled on or the clock leapt: as uncertain as it is long
            lost = max(last_speed, speed) * order.unseen
            if passed > EVEN:
                lost += self._change(last_twist, fit.twist) * passed
            self._carry(fit.twist, speed, passed, lost)
        if step.used:
            self._rolled = rolled
        reckoning = self._reckoning
        return Reckoned(fit.twist, fit.residual, reckoning.pose, reckoning.covariance(), step)

    def _speeds(self, time: float, rolled: Sequence[float]) -> list[float]:
        """Return the mean speeds [m/s] since the last state, from what the wheels rolled."""
        passed = time - self._order.stamp
        if not self._rolled or not 0.0 < passed <= self._max_gap:
            msg = 'no wheel speeds, and no distances just before to tell them from: give either'
            raise SignalError(msg)
        return [(now - last) / passed for now, last in zip(rolled, self._rolled, strict=True)]

    def _change(self, before: Twist, now: Twist) -> float:
        """Return by how much the speed of a wheel differs between two twists [m/s]."""
        return hypot(now.vx - before.vx, now.vy - before.vy) + self._base.arm * abs(
            now.wz - before.wz
        )

    def _carry(self, twist: Twist, speed: float, passed: float, lost: float) -> None:
        """Follow a twist for a time; all wheels may have rolled ``lost`` [m] beside it."""
        vx, vy, wz = twist
        variance = self._noise * self._noise * (passed * speed)
        if lost:
            variance += len(self._base) * lost * lost
        displacement = (vx * passed, vy * passed, wz * passed)
        self._reckoning.carry(displacement, self._base.unit_covariance, variance)

    def are_plain(self, times: Column, speeds: Column) -> bool:
        """Return whether each state plainly follows the one before: only such go by columns.

        Args:
            times: (n,) [s].
            speeds: (k, n) [m/s].

        """
        steps = np.diff(times)
        if self._order.last is not None:
            steps = np.append(steps, times[0] - self._order.stamp)
        return bool(
            not self._order.doubts
            and np.all((steps > 0.0) & (steps <= min(EVEN, self._max_gap)))
            and np.all(np.abs(speeds) <= self._max_speed)
        )

    def update_columns(self, times: Column, angles: Column, speeds: Column) -> ReckonedColumns:
        """Take many states.

        Args:
            times: (n,) [s].
            angles: (k, n) [rad], finite.
            speeds: (k, n) [m/s], finite.

        Raises:
            ConfigurationError: They are not :meth:`are_plain`: take them one by one.

        """
        if not self.are_plain(times, speeds):
            msg = 'states that are late, doubled or beyond their limits: take them one by one'
            raise ConfigurationError(msg)
        vx, vy, wz, residual = self._base.turrets.solve_columns(angles, speeds)
        last = self._order.last
        first = times[0] if last is None else last.stamp
        passed = times - np.concatenate([[first], times[:-1]])
        speed = sum(map(abs, speeds)) / len(speeds)
        twist = Twist(float(vx[-1]), float(vy[-1]), float(wz[-1]))
        self._order.follow(float(times[-1]), (float(speed[-1]), twist))
        self._rolled = ()
        displacement = (vx * passed, vy * passed, wz * passed)
        variance = self._noise * self._noise * (passed * speed)
        carried = self._reckoning.carry_columns(displacement, self._base.unit_covariance, variance)
        return ReckonedColumns((vx, vy, wz), residual, *carried)
