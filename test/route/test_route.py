"""Routes: waypoints, laps, places and bends, and every way to give a wrong one."""

from __future__ import annotations

from math import inf, nan, pi, radians

import pytest

from agv_motion.errors import GeometryError
from agv_motion.route.route import MOST_WAYPOINTS, Route, RoutePlace

TRIANGLE = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)]


def test_repeated_waypoints_are_dropped():
    route = Route([(0, 0), (0, 0), (4, 0), (4, 0), (4, 0), (4, 3), (4, 3)])
    assert route.waypoints == tuple(TRIANGLE)
    assert route.length == 7.0


@pytest.mark.parametrize(
    ('points', 'reason'),
    [
        ([], '0 waypoints'),
        ([(1, 2)], '1 waypoints, 1 of them distinct'),
        ([(1, 2)] * 5, '5 waypoints, 1 of them distinct'),
        ([(0, 0), (nan, 1)], 'waypoint 2 is .*must be finite'),
        ([(inf, 0), (0, 1)], 'waypoint 1 is .*must be finite'),
        ([(0, 0), (1, 2, 3)], 'waypoint 2 is .*two numbers'),
        ([(0, 0), 'ab'], 'waypoint 2 is .*two numbers'),
        ([(0, 0), None], 'waypoint 2 is None'),
    ],
)
def test_what_is_no_route_is_refused(points, reason):
    with pytest.raises(GeometryError, match=reason):
        Route(points)


def test_a_route_that_takes_too_long_to_look_through_is_refused():
    line = [(0.001 * i, 0.0) for i in range(MOST_WAYPOINTS)]
    assert len(Route(line).segments) == MOST_WAYPOINTS - 1
    with pytest.raises(GeometryError, match='a route of 20001 waypoints: at most 20000; leave out'):
        Route([*line, (0.0, 1.0)])


def test_a_negative_number_of_laps_is_refused():
    with pytest.raises(GeometryError, match='laps = -1'):
        Route(TRIANGLE, laps=-1)


@pytest.mark.parametrize(
    ('points', 'alpha'),
    [
        ([(0, 0), (1, 0), (2, 0)], pi),
        ([(0, 0), (1, 0), (0, 0)], 0.0),
        ([(0, 0), (1, 0), (1, 1)], pi / 2),
        ([(0, 0), (1, 0), (1, -1)], pi / 2),
        ([(0, 0), (1, 0), (2, 1)], 3 * pi / 4),
        ([(0, 0), (1, 0), (0, 1)], pi / 4),
    ],
)
def test_the_angle_between_two_segments(points, alpha):
    assert Route(points).bend(0) == pytest.approx(alpha, abs=1e-15)


def test_after_the_last_segment_there_is_no_bend():
    route = Route(TRIANGLE)
    assert not route.is_last(0)
    assert route.is_last(1)
    assert route.bend(1) == pi


def test_laps_close_the_route():
    """3-4-5: the way back is 5 m long, so a lap is 12 m."""
    route = Route(TRIANGLE, laps=3)
    assert route.lap_length == pytest.approx(12.0)
    assert route.length == pytest.approx(36.0)
    assert [route.is_last(number) for number in (2, 7, 8)] == [False, False, True]
    assert route.way(RoutePlace(4, 1.0)) == pytest.approx(17.0)
    assert route.point(RoutePlace(4, 1.0)) == (4.0, 1.0)
    assert route.bend(2) == pytest.approx(route.bend(5))
    assert route.bend(2) < pi
    assert route.bend(8) == pi


def test_a_route_that_is_closed_already_is_not_closed_again():
    assert len(Route([*TRIANGLE, (0, 0)], laps=2).segments) == 3


def test_laps_without_end():
    route = Route(TRIANGLE, laps=0)
    assert route.length == inf
    assert not route.is_last(10**9)


def test_each_bend_is_that_to_the_next_segment():
    """Turns of 45, 90, 0 and -135 degrees, and round to the first segment."""
    route = Route([(0, 0), (2, 0), (3, 1), (2, 2), (1, 3), (3, 3), (0, -1)], laps=2)
    bends = [pi - abs(radians(turn)) for turn in (45.0, 90.0, 0.0, 135.0)]
    assert [route.bend(i) for i in range(4)] == pytest.approx(bends)
    assert route.bend(6) == pytest.approx(pi / 2)
