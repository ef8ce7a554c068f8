"""The end of an old trajectory, at a share of its pace."""

from __future__ import annotations

import pytest

from agv_motion.planar import Pose
from agv_motion.trajectory.braking import Braking
from agv_motion.trajectory.line import Line
from agv_motion.trajectory.motion import STILL
from agv_motion.trajectory.motions import DriveMotion
from agv_motion.trajectory.trajectory import Trajectory
from agv_motion.trajectory.trapezoidal import trapezoid

START, END = Pose(0.0, 0.0, 0.0), Pose(4.0, 0.0, 0.0)


def stopped():
    """At 1 m/s after 1.5 m and 2 s, braked with 1 m/s2: it rests after 3 s at 2 m."""
    motion = DriveMotion(
        Line(0j, 4 + 0j), (START, END), trapezoid(4.0, 1.0, 1.0), 1.0, backward=False
    )
    return Trajectory((START, END), (motion,)).stopped(2.0)


def test_a_stretch_that_ends_in_motion():
    """Half a second from 1 m/s to 0.5 m/s: 0.375 m."""
    braking = Braking(stopped(), 2.0, 1.0, 0.5)
    assert braking.pose(0.0) == pytest.approx((1.5, 0.0, 0.0))
    assert braking.end == pytest.approx((1.875, 0.0, 0.0))
    assert braking.end_speeds == pytest.approx((0.5, 0.0))
    assert braking.length == pytest.approx(0.375)
    assert braking.speeds(0.25) == pytest.approx((0.75, 0.0))
    assert braking.speeds(0.5) == braking.speeds(-0.1) == STILL
    assert braking.pose(9.0) == braking.end
    assert braking.pose(-9.0) == braking.pose(0.0)
    assert not braking.rotating


def test_at_half_the_pace_it_takes_twice_as_long():
    braking = Braking(stopped(), 2.0, 0.5, 1.0)
    assert braking.end == pytest.approx((1.875, 0.0, 0.0))
    assert braking.speeds(0.0) == pytest.approx((0.5, 0.0))
    assert braking.end_speeds == pytest.approx((0.25, 0.0))
    assert braking.length == pytest.approx(0.375)


@pytest.mark.parametrize(('rate', 'left'), [(1.0, 1.0), (0.5, 2.0)])
def test_stopped_it_goes_on_to_rest(rate, left):
    rest = Braking(stopped(), 2.0, rate, 0.25).stopped(0.1)
    assert rest.duration == pytest.approx(left)
    assert rest.end == pytest.approx((2.0, 0.0, 0.0))
    assert rest.end_speeds == pytest.approx((0.0, 0.0))
