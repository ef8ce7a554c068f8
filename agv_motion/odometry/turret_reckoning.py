"""What turrets tell of their platform: how it moves, how hard they fight, and where it is."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.odometry.base import TurretBase
from agv_motion.odometry.dead_reckoning import DeadReckoning

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.kinematics.turrets import Turrets
    from agv_motion.odometry.covariance import Covariance
    from agv_motion.planar import Pose, Twist

    Column = NDArray[np.float64]


class Reckoned(NamedTuple):
    """What is known after one state of the turrets."""

    twist: Twist
    residual: float
    """[m/s] how hard the turrets pull against each other"""
    pose: Pose
    """where the wheels carried the platform"""
    covariance: Covariance
    """of the pose"""


class ReckonedColumns(NamedTuple):
    """The same after each of many states; every number is a column (n,)."""

    twist: tuple[Column, Column, Column]
    residual: Column
    pose: tuple[Column, Column, Column]
    covariance: Covariance


class TurretReckoning:
    """Takes states of the turrets, one by one or many together: to the bit the same."""

    def __init__(self, turrets: Turrets, noise: float) -> None:
        """Start at the origin, with certainty.

        Args:
            turrets: The platform.
            noise: Standard deviation of the travel of a wheel after 1 m [m].

        """
        self._turrets, self._noise = turrets, noise
        self._unit_covariance = TurretBase(turrets).unit_covariance
        self._reckoning = DeadReckoning()
        self._time: float | None = None

    def take(self, time: float, angles: Sequence[float], speeds: Sequence[float]) -> Reckoned:
        """Take one state; where its time is not after the last one, the pose stays.

        Args:
            time: Of the state [s].
            angles: (k,) steering angles [rad].
            speeds: (k,) rolling speeds along them [m/s].

        Raises:
            SignalError: A wrong number of values, or one that is not finite.

        """
        fit = self._turrets.twist(angles, speeds)
        vx, vy, wz = fit.twist
        if self._time is not None and time > self._time:
            passed = time - self._time
            rolled = passed * sum(map(abs, speeds)) / len(speeds)
            displacement = (vx * passed, vy * passed, wz * passed)
            variance = self._noise * self._noise * rolled
            self._reckoning.carry(displacement, self._unit_covariance, variance)
        self._time = time
        return Reckoned(fit.twist, fit.residual, self._reckoning.pose, self._reckoning.covariance())

    def take_columns(self, times: Column, angles: Column, speeds: Column) -> ReckonedColumns:
        """Take many states.

        Args:
            times: (n,) [s].
            angles: (k, n) [rad], finite.
            speeds: (k, n) [m/s], finite.

        """
        vx, vy, wz, residual = self._turrets.solve_columns(angles, speeds)
        first = times[0] if self._time is None else self._time
        passed = np.maximum(times - np.concatenate([[first], times[:-1]]), 0.0)
        self._time = float(times[-1])
        rolled = passed * sum(map(abs, speeds)) / len(speeds)
        displacement = (vx * passed, vy * passed, wz * passed)
        variance = self._noise * self._noise * rolled
        carried = self._reckoning.carry_columns(displacement, self._unit_covariance, variance)
        return ReckonedColumns((vx, vy, wz), residual, *carried)
