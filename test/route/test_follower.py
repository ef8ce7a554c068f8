"""The route follower: every branch of its rules with the numbers worked out by hand."""

from __future__ import annotations

from math import inf, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.planar import REST, Pose
from agv_motion.route.follower import RouteFollower, RouteLimiter
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.prediction import predict
from agv_motion.route.route import Route

CORNER = Route([(0, 0), (4, 0), (4, 4)])
TABLES = FollowParameters(
    virtual_point_distance=1.0,
    omega_dphi=(0.0, 0.0, 1.0, 1.0, 2.0, 1.5),
    v_dphi=(0.0, 1.0, 2.0, 0.2),
    v_dn=(0.0, 0.1, 1.0, 0.9),
    v_alpha=(0.0, 0.1, pi, 1.0),
    v_d=(0.0, 0.0, 2.0, 1.0),
    arrival_speed=0.0,
    speed_coupling_ms=0.0,
    turn_coupling_ms=0.0,
)


def step(pose, route=CORNER, **changes):
    return RouteFollower(route, FollowParameters(**(vars(TABLES) | changes))).step(pose, 0.1)


def at_the_end(pose, **changes):
    """Return the step at ``pose`` of a robot that has come up the last leg."""
    follower = RouteFollower(CORNER, FollowParameters(**(vars(TABLES) | changes)))
    for y in (0.0, 1.0, 2.0, 3.0, 3.3):
        follower.step(Pose(4.0, y, pi / 2), 0.1)
    return follower.step(pose, 0.1)


def test_towards_a_waypoint_far_away_it_slows_down_by_the_way_to_it():
    """Virtual point at 3: dn = 1, v(dn) = 0.9; alpha = 90 deg, v(alpha) = 0.55; d = 1 + 1 + 4."""
    found = step(Pose(2.0, 0.0, 0.0))
    assert found.virtual_point == (3.0, 0.0)
    assert found.limits.to_waypoint == pytest.approx(1.0)
    assert found.limits.bend == pytest.approx(pi / 2)
    assert found.limits.to_go == pytest.approx(6.0)
    assert found.twist == pytest.approx((0.9, 0.0, 0.0))
    assert found.limits.limiter is RouteLimiter.WAYPOINT


def test_near_a_waypoint_the_bend_says_how_slow():
    """Virtual point at 3.5: dn = 0.5, v(dn) = 0.5 < v(alpha) = 0.55."""
    found = step(Pose(2.5, 0.0, 0.0))
    assert found.twist.vx == pytest.approx(0.55)
    assert found.limits.limiter is RouteLimiter.BEND


def test_straight_on_a_waypoint_does_not_slow_it_down():
    """v(alpha) = 1 at 180 deg, whatever dn; d = 5.5."""
    found = step(Pose(2.5, 0.0, 0.0), Route([(0, 0), (4, 0), (8, 0)]))
    assert found.twist.vx == pytest.approx(1.0)


def test_before_a_hairpin_it_is_slowest():
    """With dn = 0.1: v(dn) = 0.18; alpha = 0: v(alpha) = 0.1; the larger counts."""
    found = step(Pose(2.9, 0.0, 0.0), Route([(0, 0), (4, 0), (0, 0)]))
    assert found.twist.vx == pytest.approx(0.18)
    assert found.limits.limiter is RouteLimiter.WAYPOINT


def test_looking_elsewhere_it_slows_down_and_turns():
    """With dphi = -1 rad: v(dphi) = 0.6 and omega = -1 rad/s, to the right."""
    found = step(Pose(2.0, 0.0, 1.0))
    assert found.limits.heading_error == pytest.approx(-1.0)
    assert found.twist == pytest.approx((0.6, 0.0, -1.0))
    assert found.limits.limiter is RouteLimiter.HEADING
    coupled = step(Pose(2.0, 0.0, 1.0), turn_coupling_ms=400.0, speed_coupling_ms=200.0)
    assert coupled.twist == pytest.approx((0.3, 0.0, -0.25))


def test_holonomic_it_drives_straight_at_the_point():
    """At 1 rad to the right of the heading: 0.6 (cos 1, -sin 1)."""
    found = step(Pose(2.0, 0.0, 1.0), holonomic=True)
    assert found.twist == pytest.approx((0.6 * 0.5403023058681398, -0.6 * 0.8414709848078965, -1.0))


def test_at_the_end_it_brakes_by_the_route_to_go():
    """Virtual point at the end (d = 0.5): v(d) = 0.25; no bend follows, v(alpha) = 1."""
    found = at_the_end(Pose(4.0, 3.5, pi / 2))
    assert found.virtual_point == (4.0, 4.0)
    assert found.limits.bend == pi
    assert found.twist.vx == pytest.approx(0.25)
    assert found.limits.limiter is RouteLimiter.TO_GO
    assert not found.arrived


@pytest.mark.parametrize('heading', [0.0, 0.7, -2.0])
def test_on_the_very_point_no_heading_is_wrong(heading):
    assert at_the_end(Pose(4.0, 4.0, heading)).limits.heading_error == 0.0


def test_round_the_corner_d_is_the_way_to_the_point_and_on():
    """Robot at (3.4, 0): virtual point 0.8 up the second leg, 1 away, 3.2 from the end."""
    found = step(Pose(3.4, 0.0, 0.0))
    assert found.virtual_point == pytest.approx((4.0, 0.8))
    assert found.limits.to_go == pytest.approx(4.2)


@pytest.mark.parametrize(('arrival_speed', 'y'), [(0.0, 4.0), (0.05, 3.9)])
def test_arrived_is_where_v_d_is_zero_or_slow_enough(arrival_speed, y):
    found = at_the_end(Pose(4.0, y, 1.0), arrival_speed=arrival_speed)
    assert found.arrived
    assert found.twist == REST


def test_a_table_may_end_the_route_before_its_end():
    """v(d) = 0 up to 0.5 m: arrived there."""
    changes = {'v_d': (0.0, 0.0, 0.5, 0.0, 2.0, 1.0)}
    assert not at_the_end(Pose(4.0, 3.49, pi / 2), **changes).arrived
    assert at_the_end(Pose(4.0, 3.5, pi / 2), **changes).arrived


def test_arrived_it_stays_so():
    follower = RouteFollower(CORNER, TABLES)
    for y in (0.0, 2.0, 3.0):
        assert not follower.step(Pose(4.0, y, 0.0), 0.1).arrived
    assert follower.step(Pose(4.0, 4.0, 0.0), 0.1).arrived
    later = follower.step(Pose(0.0, 0.0, 0.0), 0.1)
    assert later.arrived
    assert later.twist == REST


def test_at_the_place_of_the_end_it_has_not_arrived_before_its_last_lap():
    square = Route([(0, 0), (4, 0), (4, 4), (0, 4)], laps=2)
    follower = RouteFollower(square, TABLES)
    corners = [(3.5, 0.0), (4.0, 3.5), (0.5, 4.0), (0.0, 3.0), (0.0, 2.0), (0.0, 1.0), (0.0, 0.0)]
    arrivals = [follower.step(Pose(x, y, 0.0), 0.1).arrived for x, y in corners * 2]
    assert arrivals == [False] * 13 + [True]


def test_the_coupling_starts_anew_on_each_segment():
    """0.4 s: 0.25, 0.5 ... of V; then from 1 towards 0.6, which the heading asks for."""
    coupled = FollowParameters(**(vars(TABLES) | {'speed_coupling_ms': 400.0}))
    follower = RouteFollower(Route([(0, 0), (4, 0), (20, 0)]), coupled)
    speeds = [follower.step(Pose(x, 0.0, 0.0), 0.1) for x in (0.5, 1.0, 1.5, 2.0, 2.5)]
    assert [found.twist.vx for found in speeds] == pytest.approx([0.25, 0.5, 0.75, 1.0, 1.0])
    assert [found.limits.limiter for found in speeds[:3]] == [RouteLimiter.COUPLING] * 3
    turned = [follower.step(Pose(x, 0.0, 1.0), 0.1) for x in (3.5, 3.6, 3.7, 3.8)]
    assert [found.limits.speed for found in turned] == pytest.approx([0.6] * 4)
    assert [found.twist.vx for found in turned] == pytest.approx([0.9, 0.8, 0.7, 0.6])


def test_on_a_path_of_many_points_the_coupling_still_lets_it_brake():
    """A planner's path, a point every centimetre: each tick enters a new segment."""
    dense = Route([(0.01 * i, 0.0) for i in range(501)])
    run = predict(dense, FollowParameters(), Pose(0.0, 0.0, 0.0))
    assert run.arrived
    assert max(pose.x for pose in run.poses) < 5.02
    assert max(found.twist.vx for found in run.steps) > 0.45


def test_other_tables_may_be_given_on_the_way():
    follower = RouteFollower(CORNER, TABLES)
    slow = FollowParameters(**(vars(TABLES) | {'v_dphi': (0.0, 0.2)}))
    follower.retune(slow)
    assert follower.step(Pose(2.0, 0.0, 0.0), 0.1).twist.vx == pytest.approx(0.2)


def test_a_new_route_goes_on_from_the_present_speed():
    """A quarter of the way from 0.5 to V = 0.9."""
    coupled = FollowParameters(**(vars(TABLES) | {'speed_coupling_ms': 400.0}))
    follower = RouteFollower(CORNER, coupled, speed=0.5)
    assert follower.step(Pose(0.0, 0.0, 0.0), 0.1).twist.vx == pytest.approx(0.6)


@pytest.mark.parametrize(
    ('pose', 'dt'),
    [
        (Pose(nan, 0.0, 0.0), 0.1),
        (Pose(0.0, inf, 0.0), 0.1),
        (Pose(0.0, 0.0, 0.0), nan),
        (Pose(0.0, 0.0, 0.0), -0.1),
    ],
)
def test_a_bad_pose_or_time_is_refused_and_changes_nothing(pose, dt):
    follower = RouteFollower(CORNER, TABLES)
    with pytest.raises(SignalError, match=r'must be finite|dt = '):
        follower.step(pose, dt)
    assert follower.step(Pose(0.0, 0.0, 0.0), 0.1).virtual_point == (1.0, 0.0)


numbers = st.floats(-10.0, 10.0)


@given(
    st.lists(st.tuples(numbers, numbers), min_size=2, max_size=6, unique=True),
    st.lists(st.tuples(numbers, numbers, st.floats(-4.0, 4.0)), min_size=1, max_size=8),
)
def test_the_speed_is_never_above_any_table(waypoints, poses):
    follower = RouteFollower(Route(waypoints), TABLES)
    for pose in poses:
        found = follower.step(Pose(*pose), 0.1)
        limits = found.limits
        assert found.twist.vx <= limits.v_d
        assert found.twist.vx <= limits.v_dphi
        assert found.twist.vx <= max(limits.v_dn, limits.v_alpha)
        assert found.arrived or found.twist.vx == limits.speed
