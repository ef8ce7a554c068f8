"""The simulated differential robot: motors, slip, ticks."""

from __future__ import annotations

from math import exp, pi, sqrt

import numpy as np
import pytest

from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.planar import Pose, Twist
from agv_motion.simulation.differential import DifferentialRobot, DifferentialRobotParameters

DRIVE = DifferentialDrive(0.4, [0.05, 0.04])
START = Pose(1.0, 2.0, pi / 2)
STIFF = {'traction_lag': 0.0, 'slip_noise': 0.0, 'encoder_resolution': 0.0}


def robot(seed=1, **parameters):
    return DifferentialRobot(
        DRIVE, DifferentialRobotParameters(**(STIFF | parameters)), START, seed
    )


def test_without_lag_and_slip_it_does_what_it_is_told():
    """Hand calculation: looking along y, a quarter of a left circle of 1 m ends at (0, 3)."""
    driven = robot()
    for _ in range(10):
        driven.step(DRIVE.command(Twist(pi / 2, 0.0, pi / 2)).speed, 0.1)
    assert driven.pose == pytest.approx((0.0, 3.0, -pi), abs=1e-12)
    assert driven.twist == pytest.approx((pi / 2, 0.0, pi / 2))
    assert driven.speeds == pytest.approx([0.8 * pi / 2, 1.2 * pi / 2])
    assert driven.angles() == pytest.approx([0.8 * pi / 2 / 0.05, 1.2 * pi / 2 / 0.04])


@pytest.mark.parametrize('steps', [1, 7])
def test_a_motor_follows_with_its_lag_whatever_the_step(steps):
    """After T with lag T: speed 1 - 1/e, way T / e."""
    driven = robot(traction_lag=0.5)
    for _ in range(steps):
        driven.step([1.0, 1.0], 0.5 / steps)
    assert driven.speeds == pytest.approx([1.0 - exp(-1.0)] * 2)
    assert driven.pose.y - 2.0 == pytest.approx(0.5 * exp(-1.0))


def test_a_slipping_wheel_turns_but_does_not_carry():
    driven = robot(slip_left=0.05)
    driven.step([1.0, 1.0], 1.0)
    assert driven.angles() == pytest.approx([20.0, 25.0])
    assert driven.twist == pytest.approx((0.975, 0.0, 0.05 / 0.4))


def test_slip_is_a_random_walk_over_the_distance():
    ends = []
    for seed in range(400):
        driven = robot(seed, slip_noise=0.01)
        for _ in range(4):
            driven.step([1.0, 1.0], 1.0)
        ends.append(driven.pose.y - 6.0)
    assert np.std(ends) == pytest.approx(0.01 * sqrt(4.0 / 2.0), rel=0.15)


def test_encoders_count_ticks():
    driven = robot(encoder_resolution=0.3)
    driven.step([0.05, 0.04], 1.0)
    assert driven.angles() == pytest.approx([0.9, 0.9])


def test_carried_it_stands_elsewhere():
    driven = robot()
    driven.carry_to(Pose(0.0, 0.0, 0.0))
    assert driven.pose == (0.0, 0.0, 0.0)
    assert driven.angles() == [0.0, 0.0]
