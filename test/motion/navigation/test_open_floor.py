"""Floor that others close is taken off, and given back."""

from __future__ import annotations

import pytest
import shapely

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.open_floor import OpenFloor
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

HALL = Zone([[0, 0], [20, 0], [20, 10], [0, 10]], margin=1.0)
START, GOAL = (2.0, 5.0), (18.0, 5.0)


def test_a_path_leads_round_what_is_closed_and_straight_when_it_is_open_again():
    floor = OpenFloor(PathPlanner(HALL))
    assert floor.path(START, GOAL) == [START, GOAL]
    floor.close(shapely.box(9.0, 0.0, 11.0, 8.0))
    assert floor.path(START, GOAL) == [START, (9.0, 8.0), (11.0, 8.0), GOAL]
    floor.close(None)
    assert floor.path(START, GOAL) == [START, GOAL]


def test_a_goal_on_closed_floor_is_refused():
    floor = OpenFloor(PathPlanner(HALL))
    floor.close(shapely.box(16.0, 0.0, 20.0, 10.0))
    with pytest.raises(GeometryError, match='where another tree is or goes'):
        floor.path(START, GOAL)
