"""Where a robot is in the map, at every instant, from odometry and poses that come in any order."""

from __future__ import annotations

from math import inf, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.model.robot_transforms import RobotTransforms
from agv_motion.planar import Pose, compose, inverse

SECOND = 1_000_000_000
HOME = Pose(3.0, 4.0, 0.5)
"""Place of `odom` in the map"""
small = st.floats(-3.0, 3.0)
poses = st.builds(Pose, small, small, st.floats(-pi, 3.1))


def odom(robot, stamp, pose):
    return robot.take_odometry(round(stamp * SECOND), 'odom', 'base_link', pose)


def located(robot, stamp, pose):
    return robot.take_pose(round(stamp * SECOND), 'map', pose)


def of_map(transforms):
    return [(t.stamp / SECOND, t.translation) for t in transforms if t.child == 'odom']


@given(poses, poses)
def test_map_to_odom_and_odom_to_base_lead_to_the_pose(in_odom, in_map):
    robot = RobotTransforms(None, '')
    odom(robot, 1.0, in_odom)
    (told,) = located(robot, 1.0, in_map)
    origin = compose(in_map, inverse(in_odom))
    assert told.translation == pytest.approx((origin.x, origin.y, 0.0))
    assert compose(origin, in_odom)[:2] == pytest.approx(in_map[:2])


def test_a_pose_between_two_places_is_met_on_the_arc():
    robot = RobotTransforms(None, '')
    odom(robot, 0.0, Pose(1.0, 0.0, pi / 2))
    odom(robot, 1.0, Pose(0.0, 1.0, -pi))  # a quarter of a circle about the origin
    between = Pose(2**-0.5, 2**-0.5, 3 * pi / 4)
    (*_, told) = located(robot, 0.5, compose(HOME, between))
    assert told.translation == pytest.approx((3.0, 4.0, 0.0))


def test_a_pose_that_is_ahead_of_odometry_waits_for_it():
    robot = RobotTransforms(None, '')
    odom(robot, 0.0, Pose(0.0, 0.0, 0.0))
    assert located(robot, 1.0, Pose(5.0, 0.0, 0.0)) == []
    found = of_map(odom(robot, 1.0, Pose(1.0, 0.0, 0.0)))
    assert found == [(0.0, (4.0, 0.0, 0.0)), (1.0, (4.0, 0.0, 0.0))]


def test_a_recording_has_the_map_from_the_first_odometry_to_the_last():
    robot = RobotTransforms(None, '')
    found = []
    for i in range(10):
        found += odom(robot, 0.1 * i, Pose(0.1 * i, 0.0, 0.0))
        if i == 4:
            found += located(robot, 0.4, Pose(5.4, 0.0, 0.0))
    found += robot.last()
    stamps = [stamp for stamp, _ in of_map(found)]
    assert stamps == pytest.approx([0.0, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])
    assert all(place == pytest.approx((5.0, 0.0, 0.0)) for _, place in of_map(found))


def test_live_the_map_falls_silent_with_the_pose_and_reaches_back_to_nothing():
    robot = RobotTransforms(None, '', hold=0.25)
    found = []
    for i in range(10):
        found += odom(robot, 0.1 * i, Pose(0.0, 0.0, 0.0))
        if i == 4:
            found += located(robot, 0.4, Pose(5.0, 0.0, 0.0))
    found += robot.last()
    assert [stamp for stamp, _ in of_map(found)] == pytest.approx([0.4, 0.5, 0.6])


@pytest.mark.parametrize('hold', [1.0, inf])
def test_stamps_of_a_frame_only_grow(hold):
    robot = RobotTransforms(None, '', hold)
    found = []
    for stamp in (0.0, 0.1, 0.1, 0.05, 0.2, 0.3, 0.2, 0.4):
        found += odom(robot, stamp, Pose(stamp, 0.0, 0.0))
        for late in (stamp, stamp - 0.1, stamp - 0.05):
            found += located(robot, late, Pose(stamp, 0.0, 0.0))
    for child in ('odom', 'base_link'):
        stamps = [t.stamp for t in found if t.child == child]
        assert stamps == sorted(set(stamps))
        assert stamps


def test_a_clock_that_begins_anew_is_a_new_beginning():
    robot = RobotTransforms(None, '')
    odom(robot, 100.0, Pose(0.0, 0.0, 0.0))
    located(robot, 100.0, Pose(5.0, 0.0, 0.0))
    assert [t.child for t in odom(robot, 1.0, Pose(0.0, 0.0, 0.0))] == ['base_link']
    assert of_map(located(robot, 1.0, Pose(7.0, 0.0, 0.0))) == [(1.0, (7.0, 0.0, 0.0))]


@pytest.mark.parametrize(('frame', 'child'), [('', 'base_link'), ('odom', ''), ('odom', 'odom')])
def test_frames_that_are_none_make_no_tree(frame, child):
    assert RobotTransforms(None, '').take_odometry(0, frame, child, Pose(0, 0, 0)) == []


def test_a_pose_in_the_frame_of_odometry_makes_no_loop():
    robot = RobotTransforms(None, '')
    odom(robot, 0.0, Pose(0.0, 0.0, 0.0))
    assert robot.take_pose(0, 'odom', Pose(1.0, 0.0, 0.0)) == []
    assert robot.take_pose(0, '', Pose(1.0, 0.0, 0.0)) == []
