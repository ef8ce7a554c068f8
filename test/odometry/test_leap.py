"""What is still believed after a leap of the clock or of the odometry, by hand."""

from __future__ import annotations

from math import pi
from types import SimpleNamespace

import pytest

from agv_motion.odometry.belief import Belief, Drift
from agv_motion.odometry.continuity import LEAP, Succession
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.history import Waypoint
from agv_motion.odometry.leap import Leap
from agv_motion.planar import Pose, compose

NONE = Covariance(*[0.0] * 6)


def waypoint(stamp, x, y=0.0, theta=0.0):
    return Waypoint(stamp, Pose(x, y, theta), NONE)


def passage(step, first, now, unseen=0.0):
    return SimpleNamespace(step=step, begun=first, waypoint=now, unseen=unseen)


BEFORE = [waypoint(10.0, 1.0), waypoint(11.0, 1.5)]
"""Half a metre in a second."""


@pytest.mark.parametrize(
    ('stamp', 'of_clock'), [(11.5, False), (11.0 + LEAP, False), (11.1 + LEAP, True), (5.0, True)]
)
def test_a_clock_leaps_back_or_far_ahead(stamp, of_clock):
    leap = Leap(BEFORE, passage(Succession.RESET, None, waypoint(stamp, 9.0)))
    assert leap.of_clock is of_clock
    assert leap.of_all is of_clock
    other = Leap(BEFORE, passage(Succession.LEAP, None, waypoint(stamp, 9.0)))
    assert not other.of_all


def test_odometry_from_another_origin_leaves_the_robot_where_it_was():
    """In the map it stands at (1.5, 0) turned by the placing; the new odometry begins elsewhere."""
    placing = Pose(3.0, 4.0, pi / 2)
    new = waypoint(11.5, -7.0, 2.0, 1.0)
    leap = Leap(BEFORE, passage(Succession.RESET, None, new))
    found = leap.keep(Belief(placing, NONE, BEFORE[-1]), Drift(0.0, 0.0))
    here = compose(found.map_to_odom, new.pose)
    assert here == pytest.approx(compose(placing, BEFORE[-1].pose))
    assert found.waypoint == new


def test_where_only_the_clock_leapt_the_placing_stays():
    placing = Pose(3.0, 4.0, 0.5)
    leap = Leap(BEFORE, passage(Succession.LEAP, None, waypoint(900.0, 1.6)))
    found = leap.keep(Belief(placing, NONE, BEFORE[-1]), Drift(0.0, 0.0))
    assert found.map_to_odom == placing
    assert found.waypoint.stamp == 900.0
    assert found.waypoint.pose == BEFORE[-1].pose


def test_what_was_not_seen_makes_it_less_sure():
    """Two seconds unseen at half a metre a second before, a quarter after: a metre."""
    now = [waypoint(20.0, 5.0), waypoint(21.0, 5.25)]
    leap = Leap(BEFORE, passage(Succession.LEAP, *now, unseen=2.0))
    placing = Belief(Pose(0.0, 0.0, 0.0), NONE, waypoint(11.0, 0.0))
    covariance = leap.keep(placing, Drift(0.0, 0.0)).covariance
    assert covariance.xx == pytest.approx(1.0)
    assert covariance.yy == pytest.approx(1.0)
    assert covariance.tt == pytest.approx(0.0)
