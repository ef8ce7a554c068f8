"""The history of odometry: where the base was at any time within the horizon."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.odometry.covariance import CERTAIN, Covariance
from agv_motion.odometry.history import OdometryHistory, Waypoint
from agv_motion.planar import Pose, Twist, integrate

SPEED = st.floats(-2.0, 2.0)
START = Pose(1.0, 2.0, 3.0)
NOISE = Covariance(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)


@given(st.builds(Twist, SPEED, SPEED, SPEED), st.floats(0.0, 1.0))
def test_between_two_waypoints_it_follows_the_arc(twist, time):
    history = OdometryHistory(10.0)
    history.append(Waypoint(0.0, START, CERTAIN))
    history.append(Waypoint(1.0, integrate(START, twist, 1.0), NOISE))
    stamp, pose, noise = history.at(time)
    expected = integrate(START, twist, time)
    assert stamp == time
    assert pose[:2] == pytest.approx(expected[:2], abs=1e-9)
    assert (pose.theta - expected.theta + pi) % (2 * pi) == pytest.approx(pi, abs=1e-12)
    assert noise == pytest.approx([time * entry for entry in NOISE], abs=1e-12)


def test_a_waypoint_is_found_as_it_is():
    history = OdometryHistory(10.0)
    waypoints = [Waypoint(float(i), Pose(i, 0.0, 0.0), NOISE) for i in range(5)]
    for waypoint in waypoints:
        history.append(waypoint)
    assert [history.at(float(i)) for i in range(5)] == waypoints
    assert (history.oldest, history.newest) == (waypoints[0], waypoints[-1])


def test_what_is_older_than_the_horizon_is_forgotten_and_no_more():
    history = OdometryHistory(10.05)
    for i in range(5000):
        history.append(Waypoint(0.1 * i, Pose(0.1 * i, 0.0, 0.0), CERTAIN))
        assert history.oldest.stamp <= max(0.1 * i - 10.05, 0.0)
        assert history.oldest.stamp >= 0.1 * i - 10.0 - 26.0
        asked = max(0.1 * i - 10.05, 0.0)
        assert history.at(asked).pose.x == pytest.approx(asked, abs=1e-9)
    assert history.at(history.newest.stamp - 10.0).pose.x == pytest.approx(489.9, abs=1e-9)


def test_cleared_it_is_empty():
    history = OdometryHistory(10.0)
    history.append(Waypoint(0.0, START, CERTAIN))
    assert history
    history.clear()
    assert not history
