"""Ways inside a zone: never outside, never longer than need be."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, sqrt

import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError
from agv_motion.motion.paths import TOLERANCE, Paths, next_waypoint
from agv_motion.motion.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
WALL = [[4.9, 0], [5.1, 0], [5.1, 8], [4.9, 8]]
AROUND = Zone(SQUARE, [COLUMN], margin=0.5)
ALONG = Zone(SQUARE, [WALL], margin=0.5)
ANYWHERE = st.tuples(st.floats(0.0, 10.0), st.floats(0.0, 10.0))


def length(way):
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(way))


def test_straight_where_nothing_stands():
    assert Paths(AROUND).way((1.0, 1.0), (9.0, 2.0)) == [(1.0, 1.0), (9.0, 2.0)]


def test_round_the_column_by_hand():
    """From (1, 5) to (9, 5) past a square of half width 1.5, its corners rounded by the margin."""
    way = Paths(AROUND).way((1.0, 5.0), (9.0, 5.0))
    sharp = 2.0 * sqrt(2.5**2 + 1.5**2) + 3.0
    assert 8.0 < length(way) < sharp
    assert length(way) == pytest.approx(2 * sqrt(3.0**2 + 1.5**2) + 2.0, rel=0.01)


def test_round_the_end_of_a_wall():
    way = Paths(ALONG).way((2.0, 1.0), (8.0, 1.0))
    assert max(y for _, y in way) == pytest.approx(8.5, abs=0.01)


@given(ANYWHERE, ANYWHERE, st.sampled_from([AROUND, ALONG]))
def test_a_way_stays_on_walkable_floor_and_is_no_shorter_than_straight(start, goal, zone):
    assume(zone.walkable(*goal))
    assume(zone.walkable(*start))
    way = Paths(zone).way(start, goal)
    assert way[0] == start
    assert way[-1] == goal
    floor = shapely.union_all(zone.parts).buffer(3 * TOLERANCE)
    assert floor.covers(shapely.LineString(way)) or start == goal
    assert length(way) >= hypot(goal[0] - start[0], goal[1] - start[1]) - 1e-9


@given(ANYWHERE, ANYWHERE)
def test_the_way_back_is_as_long(start, goal):
    assume(ALONG.walkable(*goal))
    assume(ALONG.walkable(*start))
    paths = Paths(ALONG)
    assert length(paths.way(start, goal)) == pytest.approx(length(paths.way(goal, start)))


def test_a_start_within_the_margin_is_led_back_first():
    way = Paths(AROUND).way((0.1, 5.0), (2.0, 5.0))
    assert way[0] == (0.1, 5.0)
    assert way[1] == pytest.approx((0.5, 5.0))


@pytest.mark.parametrize(
    ('goal', 'word'), [((5.0, 5.0), 'lies in hole 1'), ((20.0, 5.0), 'lies outside the zone')]
)
def test_a_goal_that_cannot_be_is_refused(goal, word):
    with pytest.raises(GeometryError, match=word):
        Paths(AROUND).way((1.0, 1.0), goal)


def test_a_goal_behind_too_narrow_a_passage_is_refused():
    parted = Zone(SQUARE, [[[4.9, 0], [5.1, 0], [5.1, 9.5], [4.9, 9.5]]])
    with pytest.raises(GeometryError, match='another part of the zone'):
        Paths(parted).way((1.0, 1.0), (9.0, 1.0))


def test_the_next_waypoint_is_the_first_corner_not_yet_reached():
    way = [(0.0, 0.0), (0.1, 0.0), (2.0, 1.0), (5.0, 5.0)]
    assert next_waypoint(way, 0.3) == (2.0, 1.0)
    assert next_waypoint([(0.0, 0.0), (0.1, 0.0)], 0.3) == (0.1, 0.0)
