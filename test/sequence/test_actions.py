"""What an action asks of the Ghost: where it ends, also after a failure; what is none."""

from __future__ import annotations

from math import cos, hypot, nan, pi, radians

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.planar import Pose
from agv_motion.sequence.actions import DriveArc, GoTo, Rotate, Wait
from agv_motion.trajectory.ghost import Ghost

START = Pose(1.0, 2.0, 0.5)


def close(pose):
    return pytest.approx(pose, abs=1e-9)


@pytest.mark.parametrize(
    ('action', 'end'),
    [
        (GoTo(3.0, 4.0, 90.0), (3.0, 4.0, pi / 2)),
        (GoTo(3.0, 4.0), (3.0, 4.0, pi / 4)),  # it looks along the line
        (GoTo(3.0, 4.0, backward=True), (3.0, 4.0, -3 * pi / 4)),  # or against it
        (GoTo(1.0, 2.0), START),
        (Rotate(by=-90.0), (1.0, 2.0, 0.5 - pi / 2)),
        (Rotate(by=720.0), START),
        (Rotate(to=-170.0), (1.0, 2.0, radians(-170.0))),
        (Rotate(to=0.0), (1.0, 2.0, 0.0)),
    ],
)
def test_an_action_ends_where_it_says(action, end):
    assert action.plan(Ghost(START)).end == close(end)


def test_an_arc_by_hand():
    """A quarter round an inner circle of 2 m, on a track of 0.3 m: the middle goes round 1.15 m."""
    origin = Pose(0.0, 0.0, 0.0)
    assert DriveArc(90.0, 2.0).plan(Ghost(origin)).end == close((1.15, 1.15, pi / 2))
    back = DriveArc(90.0, 2.0, backward=True).plan(Ghost(origin))
    assert back.end == close((-1.15, 1.15, -pi / 2))


@pytest.mark.parametrize('action', [GoTo(3.0, 4.0, 90.0), GoTo(3.0, 4.0), DriveArc(90.0, 1.0)])
def test_after_a_failure_it_ends_at_the_same_pose(action):
    end = Pose(3.0, 4.0, -0.7)
    assert action.plan_again(Ghost(Pose(2.0, 2.5, 0.1)), end).end == close(end)


@pytest.mark.parametrize(('backward', 'turns'), [(False, 0.6), (True, -0.6)])
def test_after_a_failure_an_arc_goes_straight_to_its_end(backward, turns):
    """3 m ahead and 4 m to the side, 5 m in all, on its way with its front or its back ahead."""
    trajectory = DriveArc(90.0, 1.0, backward=backward).plan_again(
        Ghost(Pose(1.0, 1.0, 0.0)), Pose(4.0, 5.0, 0.0)
    )
    poses = trajectory.polyline(0.05)
    assert [4.0 * (p.x - 1.0) for p in poses] == pytest.approx([3.0 * (p.y - 1.0) for p in poses])
    half = min(poses, key=lambda p: abs(hypot(p.x - 1.0, p.y - 1.0) - 2.5))
    assert cos(half.theta) == pytest.approx(turns)


def test_after_a_failure_a_turn_goes_to_the_same_heading_where_the_robot_is():
    found = Rotate(by=720.0).plan_again(Ghost(Pose(2.0, 2.5, 0.1)), Pose(1.0, 2.0, 0.5))
    assert found.end == close((2.0, 2.5, 0.5))


@pytest.mark.parametrize(
    ('make', 'name'),
    [
        (lambda: GoTo(1.001e5, 0.0), 'x = '),
        (lambda: GoTo(0.0, -1.001e5), 'y = '),
        (lambda: GoTo(nan, 0.0), 'x = '),
        (lambda: GoTo(0.0, 0.0, 361.0), 'heading = '),
        (lambda: DriveArc(90.0, -0.1), 'diameter = '),
        (Rotate, 'by = None, to = None: give one of the two'),
        (lambda: Rotate(by=1.0, to=1.0), 'by = 1.0, to = 1.0: give one of the two'),
        (lambda: Wait(-1.0), 'seconds = '),
    ],
)
def test_what_is_no_action_is_refused(make, name):
    with pytest.raises(ConfigurationError, match=name):
        make()
