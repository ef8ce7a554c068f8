"""What the shortest path reaches round a corner, a straight line does not."""

from __future__ import annotations

import pytest

from agv_motion.errors import GeometryError
from agv_motion.motion.behavior.goals.reachability import ShortestPath, StraightLine
from agv_motion.motion.navigation.open_floor import OpenFloor
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

WALL = [[4.9, 0], [5.1, 0], [5.1, 8], [4.9, 8]]
FLOOR = OpenFloor(PathPlanner(Zone([[0, 0], [10, 0], [10, 10], [0, 10]], [WALL])))
START, BEHIND, SEEN = (1.0, 1.0), (9.0, 1.0), (1.0, 9.0)


def test_both_reach_what_can_be_seen():
    for way in (ShortestPath(), StraightLine()):
        way.require(FLOOR, START, SEEN)


def test_only_the_shortest_path_reaches_what_lies_behind_a_wall():
    ShortestPath().require(FLOOR, START, BEHIND)
    with pytest.raises(GeometryError, match=r'no straight line leads to \(9\.00, 1\.00\)'):
        StraightLine().require(FLOOR, START, BEHIND)


def test_what_is_not_walkable_is_reached_by_neither():
    for way in (ShortestPath(), StraightLine()):
        with pytest.raises(GeometryError, match='choose another'):
            way.require(FLOOR, START, (5.0, 4.0))
