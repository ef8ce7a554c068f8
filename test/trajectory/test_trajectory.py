"""Motions in a row: seamless, stopped where it is, drawn within a number of poses."""

from __future__ import annotations

from math import pi

import pytest

from agv_motion.planar import Pose
from agv_motion.trajectory.bounds import NO_RAMP
from agv_motion.trajectory.line import Line
from agv_motion.trajectory.motion import STILL
from agv_motion.trajectory.motions import DriveMotion, TurnMotion
from agv_motion.trajectory.trajectory import Trajectory
from agv_motion.trajectory.trapezoidal import trapezoid

A, B = Pose(0.0, 0.0, 0.0), Pose(2.0, 0.0, 0.0)
C, D = Pose(2.0, 0.0, pi / 2), Pose(2.0, 1.0, pi / 2)


def drive(start, end, way):
    line = Line(complex(start.x, start.y), complex(end.x, end.y))
    return DriveMotion(line, (start, end), trapezoid(way, 1.0, 1.0), 1.0, backward=False)


def corner():
    """Two metres in 3 s, a quarter turn at 1 rad/s at most, a metre in 2 s."""
    turn = TurnMotion(B, C, 1.0, trapezoid(pi / 2, 1.0, 1.0), 1.0)
    return Trajectory((A, D), (drive(A, B, 2.0), turn, drive(C, D, 1.0)))


TURN = pi / 2 + 1.0
"""[s] the quarter turn"""


def test_one_motion_after_another():
    trajectory = corner()
    assert trajectory.duration == pytest.approx(5.0 + TURN)
    assert trajectory.pose(-1.0) == A
    assert trajectory.pose(1.5) == pytest.approx((1.0, 0.0, 0.0))
    assert trajectory.pose(3.0 + TURN / 2) == pytest.approx((2.0, 0.0, pi / 4))
    assert trajectory.pose(3.0 + TURN + 1.0) == pytest.approx((2.0, 0.5, pi / 2))
    assert trajectory.pose(99.0) == D
    assert trajectory.speeds(1.5) == pytest.approx((1.0, 0.0))
    assert trajectory.speeds(3.0 + TURN / 2) == pytest.approx((0.0, 1.0))
    assert trajectory.speeds(99.0) == STILL
    assert [trajectory.rotating(t) for t in (0.0, 2.9, 3.1, 3.0 + TURN + 0.1)] == [
        False, False, True, False,
    ]  # fmt: skip


def test_stopped_within_a_motion_the_later_ones_are_gone():
    """At 1 m/s after half a metre of the first, another half."""
    stopped = corner().stopped(1.0)
    assert len(stopped.motions) == 1
    assert stopped.duration == pytest.approx(2.0)
    assert stopped.end == pytest.approx((1.0, 0.0, 0.0))
    assert stopped.start == A
    inside = corner().stopped(3.0 + 1.0)
    assert [motion.rotating for motion in inside.motions] == [False, True]
    assert inside.end == pytest.approx((2.0, 0.0, 1.0))
    whole = corner()
    assert whole.stopped(99.0) is whole


def test_a_motion_before_it_shifts_the_time():
    before = drive(Pose(-1.0, 0.0, 0.0), A, 1.0)
    longer = corner().after(before)
    assert longer.duration == pytest.approx(7.0 + TURN)
    assert longer.start == (-1.0, 0.0, 0.0)
    assert longer.pose(2.0 + 1.5) == pytest.approx((1.0, 0.0, 0.0))
    whole = corner()
    assert whole.after(drive(A, B, 0.0)) is whole


def test_without_motions_it_stands():
    standing = Trajectory((A, A))
    assert standing.duration == 0.0
    assert standing.pose(1.0) == A
    assert standing.speeds(0.0) == STILL
    assert not standing.rotating(0.0)


def test_drawn_it_keeps_its_end_and_the_number_of_poses():
    trajectory = corner()
    fine = trajectory.polyline(0.1)
    assert (fine[0], fine[-1]) == (A, D)
    assert len(fine) == int(trajectory.duration / 0.1) + 2
    assert fine[15] == pytest.approx((1.0, 0.0, 0.0))
    assert 5 <= len(trajectory.polyline(0.001, most=5)) <= 8
    assert len(trajectory.polyline(1.0, most=500)) == int(trajectory.duration) + 2


@pytest.mark.parametrize('time', [2.0, 2.5, 99.0])
def test_at_the_end_it_stands_though_a_motion_without_a_ramp_is_at_full_speed_there(time):
    line = Line(0j, 2.0 + 0j)
    at_once = DriveMotion(line, (A, B), trapezoid(2.0, 1.0, NO_RAMP), 1.0, backward=False)
    trajectory = Trajectory((A, B), (at_once,))
    assert trajectory.duration == pytest.approx(2.0)
    assert trajectory.speeds(1.999) == pytest.approx((1.0, 0.0))
    assert trajectory.pose(0.5) == pytest.approx((0.5, 0.0, 0.0))
    assert (trajectory.speeds(time), trajectory.pose(time)) == (STILL, B)


def test_one_without_a_motion_stands_at_any_time():
    nowhere = Trajectory((A, A), ())
    assert (nowhere.speeds(-1.0), nowhere.pose(-1.0), nowhere.pose(1.0)) == (STILL, A, A)


def test_of_two_motions_the_second_has_its_own_time():
    turn = TurnMotion(B, C, 1.0, trapezoid(pi / 2, 1.0, 1.0), 1.0)
    both = Trajectory((A, C), (drive(A, B, 2.0), turn))
    assert both.pose(3.0 + TURN / 2) == pytest.approx((2.0, 0.0, pi / 4))
    assert both.speeds(3.0 + TURN / 2) == pytest.approx((0.0, 1.0))
