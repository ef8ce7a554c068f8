"""Noise assumed for odometry that tells none: as of a random walk."""

from __future__ import annotations

from math import pi

import pytest

from agv_motion.errors import SignalError
from agv_motion.odometry.assumed_noise import AssumedNoise, AssumedNoiseParameters
from agv_motion.odometry.covariance import CERTAIN, shift
from agv_motion.planar import Pose

GIVEN = AssumedNoiseParameters(position=0.1, heading=0.05, turning=0.02)


def test_straight_on_and_turning_by_hand():
    """Hand calculation: 4 m cost (0.2 m)^2 and (0.1 rad)^2, pi rad on the spot 0.0004 pi."""
    noise = AssumedNoise(GIVEN)
    assert noise.follow(Pose(5.0, 1.0, 0.0)) == CERTAIN
    for i in range(1, 401):
        noise.follow(Pose(5.0 + 0.01 * i, 1.0, 0.0))
    about_robot = shift(noise.follow(Pose(9.0, 1.0, 0.0)), 9.0, 1.0)
    assert about_robot.xx == pytest.approx(0.04, rel=1e-9)
    assert about_robot.tt == pytest.approx(0.01, rel=1e-9)
    assert about_robot.yy == pytest.approx(0.04 + 0.05**2 * 4.0**3 / 3, rel=1e-3)
    turned = noise.follow(Pose(9.0, 1.0, pi / 2))
    assert turned.tt == pytest.approx(0.01 + 0.02**2 * pi / 2, rel=1e-9)


def test_rest_costs_nothing():
    noise = AssumedNoise(GIVEN)
    assert [noise.follow(Pose(1.0, 2.0, 3.0)) for _ in range(3)] == [CERTAIN] * 3


def test_a_pose_that_is_not_finite_is_refused():
    with pytest.raises(SignalError, match='pose must be finite'):
        AssumedNoise().follow(Pose(float('nan'), 0.0, 0.0))
