"""The dry run: closed forms of where each action ends and how long it takes."""

from __future__ import annotations

from math import pi, radians, sqrt

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.planar import Pose
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.route import Route
from agv_motion.sequence.actions import DriveArc, FollowRoute, GoTo, Rotate, Wait
from agv_motion.sequence.prediction import predict
from agv_motion.sequence.sequence import OnFailure, Sequence, SequenceStep
from agv_motion.trajectory.ghost_parameters import GhostParameters

FREE = GhostParameters(track=0.5, wheel_speed=100.0, lateral_acceleration=100.0, turn_rate=100.0)


def predicted(*actions, start=(0.0, 0.0, 0.0), timeout=60.0):
    steps = tuple(
        SequenceStep('x', action, timeout, OnFailure(), 'm.yaml:1:1') for action in actions
    )
    return predict(Sequence('test', steps), Pose(*start), FREE, FollowParameters())


def test_each_action_starts_where_the_last_one_ended():
    """Go to (2, 1, 90 deg), turn by 90, wait; an arc of 180 deg, 1.5 m from middle to middle."""
    found = predicted(
        GoTo(2.0, 1.0, 90.0), Rotate(by=90.0), Wait(3.0), DriveArc(180.0, 1.0), Rotate(to=0.0)
    )
    ends = [each.end for each in found]
    assert ends[0] == Pose(2.0, 1.0, pi / 2)
    assert ends[1] == ends[2] == Pose(2.0, 1.0, -pi)
    assert ends[3] == pytest.approx((2.0, -0.5, 0.0), abs=1e-12)
    assert found[0].begin == 0.0
    assert [each.begin for each in found[1:]] == pytest.approx(
        [each.begin + each.duration for each in found[:-1]]
    )


def test_a_turn_of_more_than_half_a_turn_goes_all_the_way():
    """270 deg to the right at 45 deg/s with 60 deg/s2: 270 / 45 + 45 / 60 s, and not 90 left."""
    (found,) = predicted(Rotate(by=-270.0))
    assert found.duration == pytest.approx(6.75, abs=1e-9)
    assert found.end.theta == pytest.approx(pi / 2, abs=1e-12)
    assert found.poses[20].theta < 0.0
    (half,) = predicted(Rotate(by=180.0))
    assert half.poses[20].theta > 0.0


def test_without_a_heading_it_turns_and_goes_straight():
    (found,) = predicted(GoTo(3.0, 3.0, speed=1.0, acceleration=1.0))
    assert found.end == pytest.approx((3.0, 3.0, radians(45.0)))
    assert found.length == pytest.approx(3.0 * sqrt(2.0), abs=1e-6)
    (back,) = predicted(GoTo(-3.0, 0.0, backward=True))
    assert back.end == pytest.approx((-3.0, 0.0, 0.0))
    (here,) = predicted(GoTo(0.0, 0.0), start=(0.0, 0.0, 1.0))
    assert here.duration == 0.0


def test_a_route_is_followed_from_where_the_robot_is():
    found = predicted(GoTo(1.0, 0.0, 0.0), FollowRoute(Route([(1, 0), (3, 0), (3, 2)])))
    assert found[1].end == pytest.approx((3.0, 2.0, pi / 2), abs=0.1)


def test_an_action_that_takes_longer_than_its_timeout_is_told():
    slow, endless = predicted(
        GoTo(10.0, 0.0, 0.0), FollowRoute(Route([(0, 0), (4, 0), (4, 4)], laps=0)), timeout=10.0
    )
    assert 'm.yaml:1:1: x: takes 26.3 s, but its timeout is 10 s' in slow.warning
    assert 'timeout is 10 s' in endless.warning
    assert predicted(Wait(10.0), timeout=10.0)[0].warning == ''


def test_what_cannot_be_planned_is_told_with_its_place():
    """Straight back with long handles the curve has a cusp."""
    with pytest.raises(ConfigurationError, match=r'm\.yaml:1:1: x: .*cusp'):
        predicted(GoTo(1.0, 0.0, 180.0, curve=1.0))
