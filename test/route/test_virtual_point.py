"""The virtual point, case by case with the place worked out by hand, and its laws."""

from __future__ import annotations

from math import hypot, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.route.route import Route, RoutePlace
from agv_motion.route.virtual_point import VirtualPoint

STRAIGHT = [(0, 0), (10, 0)]
CORNER = [(0, 0), (4, 0), (4, 4)]
HAIRPIN = [(0, 0), (6, 0), (0, 0)]


def ways(points, radius, *robots, laps=1):
    """Return how far along the route the point is after each place of the robot."""
    route = Route(points, laps)
    virtual = VirtualPoint(route, radius)
    result = []
    for robot in robots:
        virtual.advance(*robot)
        result.append(route.way(virtual.place))
    return result


def test_it_lies_at_its_distance_from_the_robot():
    """Beside the route by 0.6 with a radius of 1: 0.8 ahead, by Pythagoras."""
    assert ways(STRAIGHT, 1.0, (0, 0), (2, 0), (3, 0.6), (3, -0.6)) == pytest.approx(
        [1.0, 3.0, 3.8, 3.8]
    )


def test_receding_it_waits():
    assert ways(STRAIGHT, 1.0, (4, 0), (3, 0), (0, 0), (3.9, 0), (4.2, 0)) == pytest.approx(
        [5.0, 5.0, 5.0, 5.0, 5.2]
    )


def test_pushed_aside_it_waits():
    assert ways(STRAIGHT, 1.0, (4, 0), (4, 3), (4, 1.001)) == pytest.approx([5.0, 5.0, 5.0])


def test_jumped_past_it_goes_to_where_the_circle_leaves_the_route():
    assert ways(STRAIGHT, 1.0, (2, 0), (7, 0.6)) == pytest.approx([3.0, 7.8])


def test_jumped_past_beside_the_route_it_waits():
    """The circle does not touch the route: no place ahead to go to."""
    assert ways(STRAIGHT, 1.0, (2, 0), (7, 1.5)) == pytest.approx([3.0, 3.0])


def test_jumped_past_with_the_end_in_the_circle_it_waits():
    """Only a route that stays in the circle from the point to its end leads it there."""
    assert ways(STRAIGHT, 1.0, (2, 0), (9.5, 0), (10, 0)) == pytest.approx([3.0, 3.0, 3.0])


def test_pushed_near_the_end_it_waits():
    """At (300, 40) with 250: sqrt(250^2 - 40^2) = 246.779 ahead; (100, 600) is 223.6 from the end.

    Put back it goes on from there, and to the end where the route has not left the circle.
    """
    points = [(0, 0), (1000, 0), (1000, 800), (200, 800)]
    robots = (300, 40), (100, 600), (100, 700), (400, 0), (1000, 800), (750, 800), (380, 800)
    assert ways(points, 250.0, *robots) == pytest.approx(
        [546.779, 546.779, 546.779, 650.0, 2050.0, 2300.0, 2600.0], abs=1e-3
    )


def test_jumped_past_onto_another_segment():
    """Robot at (4, 2) on the second leg: the first is 2 away, the exit at (4, 3)."""
    assert ways(CORNER, 1.0, (1, 0), (4, 2)) == pytest.approx([2.0, 7.0])


def test_round_a_corner():
    """0.6 before the corner with a radius of 1: 0.8 up the second leg."""
    assert ways(CORNER, 1.0, (3.0, 0), (3.4, 0), (4, 0)) == pytest.approx([4.0, 4.8, 5.0])


def test_at_the_end_it_stays_at_the_end():
    assert ways(STRAIGHT, 1.0, (9, 0), (9.5, 0), (10, 0), (12, 0)) == pytest.approx([10.0] * 4)


def test_in_a_hairpin_it_comes_back():
    """Up to the tip; then at 5 the circle of 2 leaves the way back at 3, which is 9 of route."""
    assert ways(HAIRPIN, 2.0, (3, 0), (4, 0), (5, 0), (4, 0)) == pytest.approx(
        [5.0, 6.0, 9.0, 10.0]
    )


def test_receding_before_a_hairpin_is_no_jump_onto_the_way_back():
    """The way back leaves the circle of a robot at 2 too (at 0, 12 of route); but it fell back."""
    assert ways(HAIRPIN, 2.0, (3, 0), (2, 0), (3.5, 0)) == pytest.approx([5.0, 5.0, 5.5])


def test_receding_at_a_crossing_is_no_short_cut():
    """The route crosses itself at (5, 0); noise of 1 mm backwards must not skip the loop."""
    points = [(0, 0), (10, 0), (10, 5), (5, 5), (5, -5)]
    before, after = ways(points, 1.0, (4.5, 0), (4.499, 0))
    assert before == after == pytest.approx(5.5)


def test_at_the_start_far_away_it_waits_there():
    assert ways(STRAIGHT, 1.0, (-5, 0), (-1.2, 0), (-0.8, 0)) == pytest.approx([0.0, 0.0, 0.2])


def test_at_the_start_beside_the_middle_it_joins_there():
    assert ways(STRAIGHT, 1.0, (5, 0.6)) == pytest.approx([5.8])


def test_the_last_lap_ends():
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    places = [(3.5, 0), (4, 3.5), (0.5, 4), (0, 0.5)]
    places += [*places[:3], (0, 3), (0, 2), (0, 0.5)]
    assert ways(square, 1.0, *places, laps=2) == pytest.approx(
        [4.0 + sqrt(0.75), 8.0 + sqrt(0.75), 12.0 + sqrt(0.75), 16.0 + sqrt(0.75),
         20.0 + sqrt(0.75), 24.0 + sqrt(0.75), 28.0 + sqrt(0.75), 30.0, 31.0, 32.0]
    )  # fmt: skip


def test_a_lap_that_fits_into_the_circle_is_refused():
    with pytest.raises(ConfigurationError, match=r'a lap of 1 m by 1 m fits into the circle'):
        VirtualPoint(Route([(0, 0), (1, 0), (1, 1)], laps=2), 1.0)


numbers = st.floats(-10.0, 10.0)
points = st.tuples(numbers, numbers)
routes = st.lists(points, min_size=2, max_size=8, unique=True)


@given(routes, st.lists(points, max_size=12), st.floats(0.1, 5.0), st.sampled_from([1, 3]))
def test_it_never_goes_back_and_stays_on_the_route(waypoints, robots, radius, laps):
    route = Route(waypoints, laps)
    try:
        virtual = VirtualPoint(route, radius)
    except ConfigurationError:
        return
    last = 0.0
    for robot in robots:
        virtual.advance(*robot)
        way = route.way(virtual.place)
        assert last - 1e-9 <= way <= route.length + 1e-9
        assert 0.0 <= virtual.place.way <= route.segment(virtual.place.segment).length
        last = way


@given(routes, st.lists(points, max_size=12), st.floats(0.1, 5.0))
def test_where_it_has_moved_to_it_is_on_the_circle_or_at_the_end(waypoints, robots, radius):
    route = Route(waypoints)
    virtual = VirtualPoint(route, radius)
    for x, y in robots:
        before = virtual.place
        virtual.advance(x, y)
        distance = hypot(virtual.point.x - x, virtual.point.y - y)
        if route.way(virtual.place) >= route.length - 1e-9:
            assert distance <= radius + 1e-6 or virtual.place == before
        elif virtual.place != before:
            assert distance == pytest.approx(radius, abs=1e-6)


@given(routes, st.lists(points, max_size=12), st.floats(0.1, 5.0))
def test_outside_the_circle_it_moves_to_where_the_route_leaves_it_or_not_at_all(
    waypoints, robots, radius
):
    """By sampling the whole route: never to its end, unless it is in the circle all the way."""
    route = Route(waypoints)
    virtual = VirtualPoint(route, radius)
    for x, y in robots:
        before, start = route.way(virtual.place), virtual.point
        virtual.advance(x, y)
        after = route.way(virtual.place)
        if after == before:
            continue
        inside = [
            hypot(px - x, py - y) <= radius + 1e-6 for px, py in sampled(route, before, after)
        ]
        if hypot(start.x - x, start.y - y) <= radius:
            assert all(inside)
        else:
            (px, py) = sampled(route, after, min(after + 1e-5, route.length))[-1]
            assert hypot(virtual.point.x - x, virtual.point.y - y) == pytest.approx(radius)
            assert after > route.length - 1e-4 or hypot(px - x, py - y) > radius - 1e-6


def sampled(route, begin, end, count=200):
    """Return points of ``route`` between two distances from its start [m]."""
    found = []
    for k in range(count + 1):
        way, number = begin + (end - begin) * k / count, 0
        while way > route.segment(number).length and not route.is_last(number):
            way -= route.segment(number).length
            number += 1
        found.append(route.point(RoutePlace(number, way)))
    return found


@given(routes, points, st.floats(0.1, 5.0))
def test_a_robot_that_stands_still_does_not_move_it_twice(waypoints, robot, radius):
    route = Route(waypoints)
    virtual = VirtualPoint(route, radius)
    virtual.advance(*robot)
    first = route.way(virtual.place)
    virtual.advance(*robot)
    assert route.way(virtual.place) == pytest.approx(first, abs=1e-6)
