"""Leaving one trajectory for another: at once where that goes, with braking where it must."""

from __future__ import annotations

from itertools import pairwise
from math import pi

import pytest

from agv_motion.errors import GeometryError
from agv_motion.planar import Pose
from agv_motion.trajectory import GhostParameters, departure
from agv_motion.trajectory.braking import Braking
from agv_motion.trajectory.departure import AT_ONCE, leave
from agv_motion.trajectory.planner import Planner
from agv_motion.trajectory.request import Request

PLANNER = Planner(GhostParameters(lateral_acceleration=9.0, turn_rate=9.0))
PACE = Request(1.0, 1.0, 0.4)
START = Pose(0.0, 0.0, 0.0)


def underway(goal, seconds, **kwargs):
    """One second up to 1 m/s, then on: a straight drive of 10 m left after ``seconds``."""
    old = PLANNER.drive(START, [Pose(10.0, 0.0, 0.0)], PACE)
    new = leave(
        old, seconds, 1.0, lambda pose, speeds: PLANNER.drive(pose, [goal], PACE, speeds), **kwargs
    )
    return old, new


def test_straight_on_it_goes_over_at_full_speed():
    old, new = underway(Pose(6.0, 0.0, 0.0), 2.0)
    assert tuple(old.speeds(2.0)) == pytest.approx((1.0, 0.0))
    assert tuple(new.speeds(0.0)) == pytest.approx((1.0, 0.0))
    assert new.start == pytest.approx(old.pose(2.0))
    assert new.end == Pose(6.0, 0.0, 0.0)
    assert new.duration == pytest.approx(4.5 + 0.5, abs=1e-6)


@pytest.mark.parametrize(
    ('kwargs', 'tried'),
    [({}, [0.0, 0.5, 1.0, 1.5, 1.8, 2.0]), ({'departures': AT_ONCE}, [0.0, 2.0])],
)
def test_it_is_tried_by_quarters_of_the_braking(kwargs, tried, monkeypatch):
    """1 m/s is braked in 1 s of the trajectory, which at half the rate are 2 s."""
    asked = []

    def braking(stopped, time, rate, lasts):
        asked.append(lasts)
        return Braking(stopped, time, rate, lasts)

    def plan(pose, speeds):
        if speeds.linear:
            raise GeometryError
        return PLANNER.drive(pose, [Pose(0.0, 0.0, pi / 2)], PACE, speeds)

    monkeypatch.setattr(departure, 'Braking', braking)
    leave(PLANNER.drive(START, [Pose(10.0, 0.0, 0.0)], PACE), 2.0, 0.5, plan, **kwargs)
    assert asked == pytest.approx(tried, abs=1e-9)


@pytest.mark.parametrize('kwargs', [{}, {'departures': AT_ONCE}])
def test_to_a_goal_behind_it_rests_first(kwargs):
    """1 m/s is braked over half a metre: from x = 1.5 m on it rests at 2 m."""
    _, new = underway(Pose(0.0, 0.0, pi / 2), 2.0, **kwargs)
    places = [new.pose(0.05 * k) for k in range(int(new.duration / 0.05) + 1)]
    speeds = [new.speeds(0.05 * k).linear for k in range(len(places))]
    assert new.speeds(0.0).linear == pytest.approx(1.0)
    assert max(abs(b - a) for a, b in pairwise(speeds)) < 0.051
    assert new.end[:2] == (0.0, 0.0)
    assert min(speeds) >= -1e-9
