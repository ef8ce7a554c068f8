"""The simulated platform: motors with lag, and a body that its wheels carry."""

from __future__ import annotations

from math import exp, pi

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Pose
from agv_motion.simulation.fixes import FixParameters, FixSensor
from agv_motion.simulation.turret_platform import MotorParameters, TurretPlatform

PAIR = Turrets([(0.5, 0.0), (-0.5, 0.0)])
STIFF = MotorParameters(steering_rate=50.0, steering_lag=0.0, traction_lag=0.0)
START = Pose(1.0, 2.0, 0.0)


def test_without_lag_it_drives_a_quarter_circle():
    """Hand calculation: turning at 0.1 rad/s on the spot for 5 pi s is a quarter turn."""
    platform = TurretPlatform(PAIR, STIFF, START)
    platform.step([pi / 2, -pi / 2], [0.0, 0.0], 1.0)
    platform.step([pi / 2, -pi / 2], [0.05, 0.05], 1e-9)
    for _ in range(100):
        platform.step([pi / 2, -pi / 2], [0.05, 0.05], pi / 20)
    assert platform.pose == pytest.approx((1.0, 2.0, pi / 2), abs=1e-8)


def test_a_wheel_follows_its_command_with_its_lag():
    platform = TurretPlatform(PAIR, MotorParameters(traction_lag=0.5), START)
    platform.step([0.0, 0.0], [1.0, 1.0], 0.5)
    speed = 1.0 - exp(-1.0)
    assert platform.speeds == pytest.approx([speed] * 2)
    assert platform.twist == pytest.approx((speed / 2.0, 0.0, 0.0))  # the mean of before and after
    assert platform.pose == pytest.approx((1.0 + 0.5 * speed / 2.0, 2.0, 0.0))
    platform.step([0.0, 0.0], [0.0, 0.0], 0.5)
    assert platform.speeds == pytest.approx([speed * exp(-1.0)] * 2)
    assert platform.twist.vx == pytest.approx(speed * (1.0 + exp(-1.0)) / 2.0)


def test_a_turret_follows_its_command_with_its_lag():
    platform = TurretPlatform(PAIR, MotorParameters(steering_rate=50.0, steering_lag=0.5), START)
    platform.step([3.0, -3.0], [0.0, 0.0], 0.5)
    assert platform.angles == pytest.approx([3.0 - 3.0 * exp(-1.0), 3.0 * exp(-1.0) - 3.0])
    platform.carry_to(Pose(9.0, 9.0, 1.0))
    assert platform.pose == Pose(9.0, 9.0, 1.0)


def test_a_turret_turns_no_faster_than_its_rate():
    platform = TurretPlatform(PAIR, MotorParameters(steering_rate=0.4), START)
    platform.step([3.0, -3.0], [0.0, 0.0], 0.5)
    assert platform.angles == pytest.approx([0.2, -0.2])


def test_the_noise_of_fixes_belongs_to_its_seed():
    one, same, other = (FixSensor(FixParameters(), seed) for seed in (1, 1, 2))
    assert one.measure(START) == same.measure(START) != other.measure(START)


def test_a_negative_lag_is_refused():
    with pytest.raises(ConfigurationError, match='traction_lag = -1'):
        MotorParameters(traction_lag=-1.0)
