"""Odometry of another with a gyroscope: the same steps, better turns, no more sure than it may."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.odometry.covariance import CERTAIN, Covariance
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.odometry.gyro_odometry import GyroOdometry
from agv_motion.odometry.history import Waypoint
from agv_motion.odometry.yaw_rate import YawRate, YawRateParameters
from agv_motion.planar import Pose, wrap

STEP = st.floats(-0.2, 0.2)
STEPS = st.lists(st.tuples(STEP, STEP, STEP), min_size=1, max_size=20)
UNIT = Covariance(1e-4, 1e-5, 2e-5, 1e-4, -1e-5, 1e-4)


@given(STEPS)
def test_a_gyroscope_that_is_silent_changes_nothing(steps):
    wheels = DeadReckoning()
    wheels.set(Pose(3.0, -2.0, 1.0))
    own = GyroOdometry(Waypoint(0.0, wheels.pose, wheels.origin_covariance))
    for i, step in enumerate(steps):
        wheels.carry(step, UNIT)
        own.follow(Waypoint(0.1 * (i + 1), wheels.pose, wheels.origin_covariance), YawRate())
    assert own.pose == pytest.approx(wheels.pose, abs=1e-9)
    assert own.origin_covariance == pytest.approx(wheels.origin_covariance, abs=1e-12)


def circle(turned, gyro_rate, parameters):
    """Return the odometry after a round whose wheels and gyroscope measure wrong turns."""
    gyro, own = YawRate(parameters), None
    for i in range(127):
        gyro.add(0.1 * i, gyro_rate)
        heading = turned * 0.05 * i
        noise = Covariance(1e-9 * i, 0.0, 0.0, 1e-9 * i, 0.0, 1e-3 * i)
        waypoint = Waypoint(0.1 * i, Pose(sin(heading), 1.0 - cos(heading), wrap(heading)), noise)
        if own is None:
            own = GyroOdometry(waypoint)
        else:
            own.follow(waypoint, gyro)
    return own


def test_a_good_gyroscope_mends_bad_turns():
    sure = YawRateParameters(noise=0.001, bias=0.0, bias_walk=0.0)
    own = circle(0.9, 0.5, sure)
    assert abs(wrap(own.pose.theta - 0.05 * 126)) < 0.01
    assert own.origin_covariance.tt < 1e-4


def test_one_of_unknown_bias_is_hardly_believed():
    own = circle(1.0, 0.6, YawRateParameters(noise=0.001, bias=0.1))
    error = abs(wrap(own.pose.theta - 0.05 * 126))
    assert error < 3.0 * np.sqrt(own.origin_covariance.tt)


def test_it_begins_anew_where_odometry_does():
    own = GyroOdometry(Waypoint(0.0, Pose(0.0, 0.0, 0.0), CERTAIN))
    own.follow(Waypoint(0.1, Pose(0.1, 0.0, 0.0), UNIT), YawRate())
    own.restart(Waypoint(0.2, Pose(50.0, 0.0, 1.0), CERTAIN))
    assert own.pose == pytest.approx((50.0, 0.0, 1.0))
    assert own.origin_covariance == CERTAIN


@pytest.mark.parametrize('stamp', [-3600.0, 5.0, 2.1e9])
def test_over_a_leap_of_the_clock_the_wheels_alone_are_believed(stamp):
    """A turn measured in 0.1 s says nothing of what the clock makes of it."""
    gyro, own = YawRate(), GyroOdometry(Waypoint(0.0, Pose(0.0, 0.0, 0.0), CERTAIN))
    for i in range(3):
        gyro.add(0.05 * i, 0.5)
    own.follow(Waypoint(stamp, Pose(0.0, 0.0, 0.06), UNIT), gyro)
    assert own.pose.theta == pytest.approx(0.06, abs=1e-12)
    assert own.origin_covariance.tt == pytest.approx(UNIT.tt)
