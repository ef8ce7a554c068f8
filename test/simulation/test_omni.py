"""The simulated omni robot: where its wheels carry it, and what its encoders say of that."""

from __future__ import annotations

from math import exp, pi, sqrt

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.omniwheel_placement import mecanum_wheels
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.planar import Pose, Twist
from agv_motion.simulation.omni import OmniRobot, OmniRobotParameters

WHEELS = OmniWheels(mecanum_wheels(0.3, 0.2))
STIFF = OmniRobotParameters(traction_lag=0.0, wheel_noise=0.0)
START = Pose(1.0, 2.0, pi / 2)


def robot(parameters=STIFF, seed=1):
    return OmniRobot(WHEELS, [0.1, 0.1, 0.1, 0.2], parameters, START, seed)


def test_without_lag_and_slip_it_does_what_it_is_told():
    """Hand calculation: looking along y, 2 s at 0.5 m/s ahead end 1 m along y."""
    driven = robot()
    for _ in range(20):
        driven.step(WHEELS.command(Twist(0.5, 0.0, 0.0)).speed, 0.1)
    assert driven.pose == pytest.approx((1.0, 3.0, pi / 2), abs=1e-12)
    assert driven.angles() == pytest.approx([10.0, 10.0, 10.0, 5.0], abs=1e-12)


def test_a_wheel_follows_with_its_lag():
    driven = robot(OmniRobotParameters(traction_lag=0.5))
    driven.step([1.0] * 4, 0.5)
    assert driven.speeds == pytest.approx([1.0 - exp(-1.0)] * 4)


def test_slip_is_a_random_walk_over_the_distance():
    ends = []
    for seed in range(400):
        driven = robot(OmniRobotParameters(traction_lag=0.0, wheel_noise=0.01), seed)
        for _ in range(20):
            driven.step([1.0] * 4, 0.2)
        ends.append(0.1 * driven.angles()[0] - 4.0)
    assert np.std(ends) == pytest.approx(0.01 * sqrt(4.0), rel=0.1)
    assert robot(seed=1).angles() == robot(seed=1).angles()


def test_encoders_round_and_break():
    driven = robot(OmniRobotParameters(traction_lag=0.0, wheel_noise=0.0, encoder_resolution=0.3))
    driven.encoders[1].gain = 0.0
    driven.step([1.0] * 4, 0.1)
    assert driven.angles() == pytest.approx([0.9, 0.0, 0.9, 0.6], abs=1e-12)


def test_carried_away_its_wheels_stand_still():
    driven = robot()
    driven.carry_to(Pose(9.0, 9.0, 0.0))
    assert driven.pose == Pose(9.0, 9.0, 0.0)
    assert driven.angles() == [0.0] * 4


def test_a_negative_lag_is_refused():
    with pytest.raises(ConfigurationError, match='traction_lag = -1'):
        OmniRobotParameters(traction_lag=-1.0)
