"""Turns and drives as functions of time: ends, senses, derivatives, and stops on the way."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.planar import Pose, wrap
from agv_motion.trajectory.arc import Arc
from agv_motion.trajectory.arc_length import ArcLength
from agv_motion.trajectory.bezier import CubicBezier
from agv_motion.trajectory.circle import Circle
from agv_motion.trajectory.line import Line
from agv_motion.trajectory.motion import STILL
from agv_motion.trajectory.motions import DriveMotion, TurnMotion
from agv_motion.trajectory.trapezoidal import trapezoid

HERE = Pose(1.0, 2.0, 3.0)


def turn(sign):
    """By 2 rad, at most 1 rad/s, ramps of 1 rad/s2: 3 s."""
    end = HERE._replace(theta=wrap(3.0 + sign * 2.0))
    return TurnMotion(HERE, end, sign, trapezoid(2.0, 1.0, 1.0), 1.0)


def drive(*, backward=False):
    """Five metres towards (4, 6), at most 1 m/s, ramps of 1 m/s2: 6 s."""
    heading = 0.9272952180016122 - (pi if backward else 0.0)
    ends = Pose(1.0, 2.0, heading), Pose(4.0, 6.0, heading)
    line = Line(1 + 2j, 4 + 6j)
    return DriveMotion(line, ends, trapezoid(5.0, 1.0, 1.0), 1.0, backward=backward)


@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_a_turn_stays_in_place_and_wraps(sign):
    motion = turn(sign)
    assert (motion.duration, motion.angle, motion.length) == pytest.approx((3.0, 2.0, 0.0))
    assert motion.rotating
    assert motion.pose(-1.0) == HERE
    assert motion.pose(1.5) == pytest.approx((1.0, 2.0, wrap(3.0 + sign)))
    assert motion.pose(9.0) == motion.end
    assert motion.speeds(1.5) == (0.0, sign)
    assert motion.speeds(0.5) == (0.0, sign * 0.5)
    assert motion.speeds(-0.1) == motion.speeds(3.0) == STILL


@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_a_turn_that_is_stopped_brakes_to_rest(sign):
    """At 1 rad/s after half a radian, another half of one."""
    motion = turn(sign).stopped(1.0)
    assert motion.duration == pytest.approx(2.0)
    assert motion.pose(0.7) == turn(sign).pose(0.7)
    assert motion.end == pytest.approx((1.0, 2.0, wrap(3.0 + sign)))
    whole = turn(sign)
    assert whole.stopped(3.0) is whole


def test_a_drive_looks_along_its_way_or_against_it():
    for backward, sense in ((False, 1.0), (True, -1.0)):
        motion = drive(backward=backward)
        assert (motion.duration, motion.length, motion.rotating) == (6.0, 5.0, False)
        assert motion.pose(-1.0) == motion.start
        assert motion.pose(3.0) == pytest.approx((2.5, 4.0, motion.start.theta))
        assert motion.pose(6.0) == motion.end
        assert motion.speeds(3.0) == (sense, 0.0)
        assert motion.speeds(0.5) == (sense * 0.5, 0.0)
        assert motion.speeds(-0.1) == motion.speeds(6.0) == STILL


@pytest.mark.parametrize('backward', [False, True])
def test_a_drive_that_is_stopped_rests_on_its_way(backward):
    """At 1 m/s after half a metre, another half of one."""
    motion = drive(backward=backward).stopped(1.0)
    assert motion.duration == pytest.approx(2.0)
    assert motion.end == pytest.approx((1.6, 2.8, motion.start.theta))
    assert motion.speeds(1.5) == pytest.approx((-0.5 if backward else 0.5, 0.0))
    assert motion.stopped(2.0) is motion


@pytest.mark.parametrize('backward', [False, True])
@given(st.floats(0.1, 0.9), st.floats(0.2, 3.0), st.floats(-2.0, 2.0))
def test_the_turn_rate_of_a_drive_does_not_depend_on_how_its_curve_is_told(
    backward, share, ahead, aside
):
    """Handles of any length: the curve is passed at a pace of its own."""
    course = ArcLength([CubicBezier(0j, 4 + 1j, complex(ahead, aside), complex(ahead, -aside))])
    start, end = Pose(0.0, 0.0, 0.0), Pose(4.0, 1.0, 0.0)
    profile = trapezoid(4.0, 0.4, 0.3)
    motion = DriveMotion(course, (start, end), profile, 0.3, backward=backward)
    time, h = share * motion.duration, 1e-5
    before, after = motion.pose(time - h), motion.pose(time + h)
    turned = wrap(after.theta - before.theta) / (2 * h)
    assert motion.speeds(time).angular == pytest.approx(turned, rel=1e-2, abs=1e-3)


@settings(max_examples=40)
@given(
    st.floats(0.3, 3.0) | st.floats(-3.0, -0.3),
    st.sampled_from([0.4, -0.4]), st.floats(0.1, 0.9),
)  # fmt: skip
def test_speeds_are_the_derivatives_of_the_pose(angle, speed, share):
    arc, start = Arc(angle, 1.1, 0.3, speed, 0.3), Pose(0.3, -0.2, 0.7)
    course = Circle(arc, start)
    motion = DriveMotion(
        course, (start, start), trapezoid(arc.length, 0.4, 0.3), 0.3, backward=speed < 0.0
    )
    time, h = share * motion.duration, 1e-5
    before, after = motion.pose(time - h), motion.pose(time + h)
    linear, angular = motion.speeds(time)
    step = complex(after.x - before.x, after.y - before.y) / (2 * h)
    assert abs(step) == pytest.approx(abs(linear), abs=1e-5)
    assert linear * speed > 0.0
    assert angular == pytest.approx(wrap(after.theta - before.theta) / (2 * h), abs=1e-4)
    assert angular * angle * speed > 0.0
