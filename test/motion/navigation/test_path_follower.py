"""A tree that is alone keeps to its path: planned when it must be, followed by its corners."""

from __future__ import annotations

from math import dist

import pytest

from agv_motion.motion.navigation.navigator import Guidance
from agv_motion.motion.navigation.path_follower import PathFollower, Waypoints
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
WALL = [[4.9, 0], [5.1, 0], [5.1, 8], [4.9, 8]]
AROUND = Zone(SQUARE, [COLUMN], margin=0.5)
ALONG = Zone(SQUARE, [WALL], margin=0.5)
GOAL = (8.0, 1.0)


class CountedPlanner(PathPlanner):
    """Counts how often it plans."""

    plans = 0

    def path(self, start, goal):
        self.plans += 1
        return super().path(start, goal)


@pytest.fixture
def planner():
    return CountedPlanner(ALONG)


def test_the_next_corner_is_the_target_and_the_path_ends_at_the_goal(planner):
    guidance = PathFollower(planner).navigate(GOAL, (2.0, 1.0), 0.0)
    assert guidance.path[0] == (2.0, 1.0)
    assert guidance.target == guidance.path[1]
    assert guidance.target[1] == pytest.approx(8.0, abs=0.6)
    assert guidance.path[-1] == GOAL
    follower, here = PathFollower(planner), (2.0, 1.0)
    assert follower._path_to(GOAL, here, 0.0)[0] == here  # noqa: SLF001 - all of it
    assert dist(follower._path_to(GOAL, (2.0, 2.0), 1.0)[0], (2.0, 2.0)) < 0.3  # noqa: SLF001


@pytest.mark.parametrize(
    ('here', 'goal', 'now', 'plans'),
    [
        ((2.0, 1.1), GOAL, 59.0, 1),
        ((2.0, 1.1), GOAL, 60.0, 2),
        ((2.0, 1.1), (7.0, 1.0), 0.5, 2),
        ((3.0, 5.0), GOAL, 0.9, 1),
        ((1.0, 5.0), GOAL, 1.0, 2),
        ((2.0, 1.1), GOAL, -1.0, 2),
    ],
)
def test_it_is_planned_again_for_another_goal_off_the_path_and_now_and_then(
    planner, here, goal, now, plans
):
    follower = PathFollower(planner)
    follower.navigate(GOAL, (2.0, 1.0), 1000.0)
    follower.navigate(goal, here, 1000.0 + now)
    assert planner.plans == plans


def test_a_small_step_back_into_the_margins_is_made_on_the_way(planner):
    """Margins are 0.5 m wide: from 0.1 m it goes out of them first, from 0.4 m ahead as well."""

    def target(y):
        return PathFollower(planner).navigate(GOAL, (2.0, y), 0.0).target

    assert target(0.1) == pytest.approx((2.0, 0.5), abs=1e-6)
    assert dist(target(0.4), (2.0, 0.5)) == pytest.approx(0.3, abs=1e-6)
    assert target(0.4)[1] > 0.7
    assert target(0.9)[1] > 7.0


def test_no_path_is_told_and_looked_for_again_at_once(planner):
    follower = PathFollower(planner)
    failed = follower.navigate((5.0, 4.0), (2.0, 1.0), 0.0)
    assert (failed.target, failed.path) == (None, ())
    assert 'choose another' in str(failed.failure)
    assert follower.navigate(GOAL, (2.0, 1.0), 0.1).failure is None


def test_straight_back_nothing_is_planned(planner):
    guidance = PathFollower(planner).navigate((0.5, 2.0), (-0.5, 2.0), 0.0, straight=True)
    assert guidance == Guidance((0.5, 2.0), ((-0.5, 2.0), (0.5, 2.0)))
    assert planner.plans == 0


def test_without_a_goal_it_goes_nowhere_and_closes_no_floor(planner):
    follower = PathFollower(planner)
    follower.rest((2.0, 1.0), 0.0)
    assert follower.navigate(None, (2.0, 1.0), 0.0) == Guidance()
    assert follower.closed() is None


def test_a_corner_is_skipped_when_near_and_the_next_can_be_seen():
    waypoints = Waypoints(AROUND, reach=0.3, slack=0.1)
    path = [(1.0, 1.0), (1.1, 1.0), (2.0, 1.0), (5.0, 2.0)]
    assert waypoints.reached(path[0], path[1:]) == 1
    assert waypoints.ahead(path[0], path) == tuple(path[2:])
    assert waypoints.ahead((1.0, 1.0), [(1.0, 1.0), (1.1, 1.0)]) == ((1.1, 1.0),)
    assert waypoints.ahead((1.0, 1.0), [(1.1, 1.0)]) == ((1.1, 1.0),)


def test_a_near_corner_is_not_cut_by_more_than_the_slack():
    """0.29 m before the end of the wall, the line to the other side would pass through it."""
    path = [(4.3, 8.21), (4.4, 8.5), (5.6, 8.5), (8.0, 1.0)]
    waypoints = Waypoints(ALONG, reach=0.31, slack=0.1)
    assert waypoints.reached(path[0], path[1:]) == 0
    assert waypoints.ahead(path[0], path) == tuple(path[1:])


def test_off_the_way_behind_an_edge_one_goes_back_to_the_way_first():
    """A metre beside the path, the wall stands before its corner: not straight there."""
    waypoints = Waypoints(ALONG, reach=0.3, slack=0.02)
    path = [(4.4, 8.0), (4.4, 9.0), (8.0, 9.0)]
    assert waypoints.ahead((4.4, 8.0), path) == tuple(path[1:])
    assert waypoints.ahead((4.8, 8.0), path) == ((4.4, pytest.approx(8.3)), *path[1:])
