"""Fuzz the odometries and the fusion: any numbers are taken or refused, and what is told is sound.

launch_scripts/fuzz/fuzz_odometry.py [INPUTS] [SEED]: the long form of test/odometry/test_fuzz.py.
"""

from __future__ import annotations

import random
import sys
from math import inf, isfinite, nan, pi

from agv_motion.errors import AgvMotionError
from agv_motion.kinematics.omniwheel_placement import wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.assumed_noise import AssumedNoise
from agv_motion.odometry.base import DifferentialBase
from agv_motion.odometry.covariance import Covariance, is_positive_definite
from agv_motion.odometry.fix import Fix
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.gates import is_noise
from agv_motion.odometry.odometry_intake import OdometryIntake
from agv_motion.odometry.omni_odometry import OmniOdometry
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.turret_odometry import TurretOdometry
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.odometry.yaw_rate import YawRate
from agv_motion.planar import Pose

HUGE = (0.0, -0.0, nan, inf, -inf, 1e-320, 1e-12, 1e6, 1e9, -1e20, 1e30, 1e100, -1e150, 1e308)
STEP = 0.05


class Fuzz:
    """All odometries and a fusion under one stream of inputs, some of them anything."""

    def __init__(self, seed: int) -> None:
        """Start everything anew."""
        self._random = random.Random(seed)  # noqa: S311 - no secret
        self._share = self._random.choice((0.0, 0.02, 0.2))
        self._time = self._random.choice((0.0, 100.0, 1.7e9))
        self._way = 0.0
        given = OdometryParameters(encoder_range=self._random.choice((0.0, 2.0 * pi)))
        self._differential = WheelOdometry(DifferentialBase(0.5), [0.1, 0.1], given)
        omni = OmniWheels(wheels_on_circle([pi / 6, 5 * pi / 6, 3 * pi / 2], [0.3] * 3))
        self._omni = OmniOdometry(omni, [0.1] * 3, given)
        self._turrets = TurretOdometry(Turrets([(0.8, -0.8), (0.8, 0.8), (-1.2, 0.0)]), 0.02)
        limits = FusionParameters(tag_x=0.8)
        self._fusion, self._plain = PoseFusion(limits), PoseFusion(limits)
        self._intake = OdometryIntake(limits, AssumedNoise())
        self._gyro = YawRate()
        self._acts = (
            self._feed_wheels, self._feed_omni, self._feed_turrets, self._feed_odometry,
            self._feed_odometry, self._feed_odometry, self._feed_gyro, self._feed_fix,
            self._feed_fix, self._set_pose,
        )  # fmt: skip

    def step(self) -> None:
        """Feed one input to one of them, and require that what they tell is sound."""
        self._time += STEP
        if self._random.random() < 0.3 * self._share:
            self._time += self._random.choice((-1e6, -20.0, -3.0, 3.0, 20.0, 1e6))
        self._way += 0.5 * STEP
        act = self._random.choice(self._acts)
        try:
            act()
        except AgvMotionError as error:
            if not str(error):
                msg = 'an error without a word'
                raise AssertionError(msg) from error
        self._require_sound()

    def _number(self, value: float) -> float:
        """Return the value, or now and then anything."""
        if self._random.random() >= self._share:
            return value
        chance = self._random
        return chance.choice((*HUGE, chance.uniform(-10.0, 10.0), 10.0 ** chance.uniform(-9, 40)))

    def _numbers(self, *values: float) -> list[float]:
        return [self._number(value) for value in values]

    def _covariance(self, variance: float) -> Covariance:
        return Covariance(*self._numbers(variance, 0.0, 0.0, variance, 0.0, variance))

    def _feed_wheels(self) -> None:
        angles = self._numbers(10.0 * self._way, 10.0 * self._way)
        by_rate = self._random.random() < 0.5
        self._differential.update(self._number(self._time), angles, by_rate=by_rate)

    def _feed_omni(self) -> None:
        turned = 10.0 * self._way
        angles: list[float | None] = [*self._numbers(turned, -turned, 0.0)]
        if self._random.random() < self._share:
            angles[self._random.randrange(3)] = None
        self._omni.update(self._number(self._time), angles)

    def _feed_turrets(self) -> None:
        speeds = self._numbers(0.5, 0.5, 0.5)
        self._turrets.update(self._number(self._time), self._numbers(0.1, 0.1, 0.1), speeds)

    def _feed_gyro(self) -> None:
        self._gyro.add(self._number(self._time), self._number(0.1))

    def _feed_odometry(self) -> None:
        stamp, pose = self._number(self._time), Pose(*self._numbers(self._way, 0.0, 0.0))
        noise = self._covariance(1e-4 * (1.0 + self._way))
        if self._random.random() < 0.5:
            self._fusion.follow(self._intake.take(stamp, pose, noise, self._gyro))
        else:
            self._plain.add_odometry(stamp, pose, noise)

    def _feed_fix(self) -> None:
        heading = None if self._random.random() < 0.5 else self._number(0.0)
        stamp, x, y = self._numbers(self._time - 0.1, self._way, 0.0)
        fix = Fix(stamp, x, y, self._covariance(0.02), heading)
        self._fusion.add_fix(fix)
        self._plain.add_fix(fix)

    def _set_pose(self) -> None:
        if self._random.random() < 0.01:
            pose = Pose(*self._numbers(self._way, 0.0, 0.0))
            fusion = self._random.choice((self._fusion, self._plain))
            fusion.set_pose(pose, self._covariance(0.1))

    def _require_sound(self) -> None:
        """Raise unless all that is told is finite, and every covariance can be one."""
        told: list[float] = []
        for fusion in (self._fusion, self._plain):
            fusion.health()
            estimate = fusion.estimate()
            if estimate is None:
                continue
            told += [estimate.stamp, *estimate.pose, *estimate.covariance, *estimate.map_to_odom]
            if not is_positive_definite(estimate.covariance):
                msg = f'the fusion tells {estimate.covariance}'
                raise AssertionError(msg)
        for odometry in (self._differential, self._omni.reckoning):
            told += [*odometry.pose, *odometry.twist, *odometry.twist_covariance()]
            self._require_noise(odometry.covariance())
        told += [self._gyro.bias, self._gyro.bias_variance, self._gyro.rate]
        if not all(map(isfinite, told)):
            msg = f'told is {told}'
            raise AssertionError(msg)

    @staticmethod
    def _require_noise(covariance: Covariance) -> None:
        scale = max(1.0, covariance.xx, covariance.yy, covariance.tt)
        share = Covariance(*(entry / scale for entry in covariance))
        if not all(map(isfinite, covariance)) or not is_noise(share, 1e-9):
            msg = f'odometry tells {covariance}'
            raise AssertionError(msg)


def fuzz(inputs: int, seed: int, each: int = 500) -> int:
    """Feed some inputs, ``each`` of them to one set of odometries; return how many were fed."""
    fed = 0
    while fed < inputs:
        rig = Fuzz(seed + fed)
        for _ in range(each):
            rig.step()
            fed += 1
    return fed


if __name__ == '__main__':
    asked = [int(word) for word in sys.argv[1:]]
    print(f'{fuzz(*(asked + [100_000, 1][len(asked) :]))} inputs, all taken or refused')
