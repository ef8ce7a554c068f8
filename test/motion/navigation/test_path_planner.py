"""Paths inside a zone: never outside, never longer than need be."""

from __future__ import annotations

from itertools import combinations
from math import hypot, sqrt
from random import Random

import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.polyline import ROUNDING, length
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
WALL = [[4.9, 0], [5.1, 0], [5.1, 8], [4.9, 8]]
AROUND = Zone(SQUARE, [COLUMN], margin=0.5)
ALONG = Zone(SQUARE, [WALL], margin=0.5)
PATHS = PathPlanner(ALONG)
ANYWHERE = st.tuples(st.floats(0.5, 9.5), st.floats(0.5, 9.5))


def test_straight_where_nothing_stands():
    assert PathPlanner(AROUND).path((1.0, 1.0), (9.0, 2.0)) == [(1.0, 1.0), (9.0, 2.0)]


def test_round_the_column_by_hand():
    """From (1, 5) to (9, 5) past a square of half width 1.5, its corners rounded by the margin."""
    path = PathPlanner(AROUND).path((1.0, 5.0), (9.0, 5.0))
    sharp = 2.0 * sqrt(2.5**2 + 1.5**2) + 3.0
    assert 8.0 < length(path) < sharp
    assert length(path) == pytest.approx(2 * sqrt(3.0**2 + 1.5**2) + 2.0, rel=0.01)


def test_round_the_end_of_a_wall():
    path = PathPlanner(ALONG).path((2.0, 1.0), (8.0, 1.0))
    assert max(y for _, y in path) == pytest.approx(8.5, abs=0.01)


@given(ANYWHERE, ANYWHERE, st.sampled_from([(AROUND, PathPlanner(AROUND)), (ALONG, PATHS)]))
def test_a_way_stays_on_walkable_floor_and_is_no_shorter_than_straight(start, goal, place):
    zone, paths = place
    assume(zone.walkable(*goal))
    assume(zone.walkable(*start))
    path = paths.path(start, goal)
    assert path[0] == start
    assert path[-1] == goal
    assert paths.is_straight(start, goal) is (len(path) == 2)
    floor = shapely.union_all(zone.parts).buffer(3 * ROUNDING)
    assert floor.covers(shapely.LineString(path)) or start == goal
    assert length(path) >= hypot(goal[0] - start[0], goal[1] - start[1]) - 1e-9


@given(ANYWHERE, ANYWHERE, st.sampled_from([AROUND, ALONG]))
def test_the_first_way_that_is_asked_for_is_as_short_as_any_later_one(start, goal, zone):
    """The first is searched for, the second looked up."""
    assume(zone.walkable(*goal))
    assume(zone.walkable(*start))
    paths = PathPlanner(zone)
    first, second = paths.path(start, goal), paths.path(start, goal)
    assert length(first) == pytest.approx(length(second), abs=1e-9)
    assert paths._parts[0]._floor.covers(shapely.LineString(first)) or start == goal  # noqa: SLF001


@given(ANYWHERE, ANYWHERE)
def test_the_way_back_is_as_long(start, goal):
    assume(ALONG.walkable(*goal))
    assume(ALONG.walkable(*start))
    paths = PATHS
    assert length(paths.path(start, goal)) == pytest.approx(length(paths.path(goal, start)))


def test_a_start_within_the_margin_is_led_back_first():
    path = PathPlanner(AROUND).path((0.1, 5.0), (2.0, 5.0))
    assert path[0] == (0.1, 5.0)
    assert path[1] == pytest.approx((0.5, 5.0))


@pytest.mark.parametrize(
    ('goal', 'word'), [((5.0, 5.0), 'lies in hole 1'), ((20.0, 5.0), 'lies outside the zone')]
)
def test_a_goal_that_cannot_be_is_refused(goal, word):
    with pytest.raises(GeometryError, match=word):
        PathPlanner(AROUND).path((1.0, 1.0), goal)


def test_a_goal_behind_too_narrow_a_passage_is_refused():
    parted = Zone(SQUARE, [[[4.9, 0], [5.1, 0], [5.1, 9.5], [4.9, 9.5]]])
    with pytest.raises(GeometryError, match='another part of the zone'):
        PathPlanner(parted).path((1.0, 1.0), (9.0, 1.0))


ROOMS = Zone(
    [[0, 0], [12, 0], [12, 8], [0, 8]],
    [
        [[5.9, 0.0], [6.1, 0.0], [6.1, 3.3], [5.9, 3.3]],
        [[5.9, 5.86], [6.1, 5.86], [6.1, 8.0], [5.9, 8.0]],
    ],
    margin=1.18,
)
"""Two rooms and a door of platform width plus 20 cm."""


def test_through_a_narrow_door():
    path = PathPlanner(ROOMS).path((2.0, 2.0), (10.0, 2.0))
    floor = ROOMS.floor.buffer(-1.18 * 0.995)  # arcs round corners are polygons
    assert floor.covers(shapely.LineString(path))
    assert any(4.4 < y < 4.8 and 4.7 < x < 7.3 for x, y in path)


def test_ways_keep_off_what_others_take():
    paths = PathPlanner(AROUND)
    assert len(paths.path((1.0, 2.0), (9.0, 2.0))) == 2
    taken = shapely.box(4.0, -1.0, 5.0, 5.0)
    path = shapely.LineString(paths.without(taken).path((1.0, 2.0), (9.0, 2.0)))
    assert not path.crosses(taken)
    assert path.length > 12.0


def test_a_goal_or_a_passage_that_others_take_is_told():
    taken = PathPlanner(ROOMS).without(shapely.box(5.0, 0.0, 7.0, 8.0))
    with pytest.raises(GeometryError, match='the passage is taken'):
        taken.path((2.0, 2.0), (10.0, 2.0))
    with pytest.raises(GeometryError, match='where another tree is'):
        taken.path((2.0, 2.0), (6.0, 4.5))


def crowded(seed):
    """Return a zone of 20 m with four skew holes, from a seed."""
    draw = Random(seed)  # noqa: S311 - a zone, no secret
    holes = []
    for k in range(4):
        x, y = 6.0 + 8.0 * (k % 2), 6.0 + 8.0 * (k // 2)
        corners = [(1, 0), (0, 1), (-1, 0), (0, -1)]
        holes.append(
            [[x + draw.uniform(0.5, 2) * a, y + draw.uniform(0.5, 2) * b] for a, b in corners]
        )
    return Zone([[0, 0], [20, 0], [20, 20], [0, 20]], holes)


@pytest.mark.parametrize('seed', range(2))
def test_no_shorter_way_than_by_an_independent_search(seed):
    """Dijkstra over all corners, the pointless ones included, by networkx."""
    import networkx as nx  # a quarter of a second, that only this test needs

    zone = crowded(seed)
    floor = zone.parts[0].buffer(ROUNDING)
    corners = [p for ring in (floor.exterior, *floor.interiors) for p in ring.coords[:-1]]
    draw = Random(seed)  # noqa: S311 - a zone, no secret
    ends = [
        e
        for e in ((draw.uniform(0, 20), draw.uniform(0, 20)) for _ in range(40))
        if zone.walkable(*e)
    ][:6]
    graph = nx.Graph()
    shapely.prepare(floor)
    pairs = list(combinations([*corners, *ends], 2))
    lines = shapely.linestrings(pairs)
    graph.add_weighted_edges_from(
        (a, b, line.length)
        for (a, b), line, is_free in zip(pairs, lines, floor.covers(lines), strict=True)
        if is_free
    )
    paths = PathPlanner(zone)
    for a, b in combinations(ends, 2):
        expected = nx.dijkstra_path_length(graph, a, b)
        assert length(paths.path(a, b)) == pytest.approx(expected, abs=1e-4)


def test_way_back_never_leads_through_a_wall():
    """A dead end narrower than the margins behind a thin wall: the nearest floor is no way."""
    zone = Zone(
        [[0, 0], [10, 0], [10, 6], [4, 6], [4, 5], [0, 5]],
        [[[4.5, 0.5], [4.6, 0.5], [4.6, 5.6], [4.5, 5.6]]],
    )
    x, y = zone.way_back(4.2, 4.9)
    assert zone.floor.buffer(1e-6).covers(shapely.LineString([(4.2, 4.9), (x, y)]))
