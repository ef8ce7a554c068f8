"""An ideal robot reaches the goal of seeded random routes, at every rate and of every base."""

from __future__ import annotations

import random
from itertools import pairwise
from math import hypot, pi, sqrt

import pytest

from agv_motion.planar import Pose, Twist
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.prediction import Prediction, predict
from agv_motion.route.route import Route
from agv_motion.route.speeds import RouteLimiter
from agv_motion.twist_limits import TwistLimits

PARAMETERS = FollowParameters()


def random_run(seed, **options):
    """Return route and prediction; the robot starts within 2 m of the route's start."""
    dice = random.Random(seed)  # noqa: S311 - a simulation, no secret
    route = Route([(dice.uniform(-5, 5), dice.uniform(-5, 5)) for _ in range(dice.randint(2, 7))])
    x, y = route.waypoints[0]
    start = Pose(x + dice.uniform(-2, 2), y + dice.uniform(-2, 2), dice.uniform(-pi, pi))
    return route, predict(route, **({'parameters': PARAMETERS, 'start': start} | options))


@pytest.mark.parametrize('holonomic', [False, True])
def test_it_reaches_the_goal(holonomic):
    for seed in range(25):
        route, run = random_run(seed, parameters=FollowParameters(holonomic=holonomic))
        end = run.poses[-1]
        assert run.arrived, seed
        assert hypot(end.x - route.waypoints[-1].x, end.y - route.waypoints[-1].y) < 0.02, seed


@pytest.mark.parametrize('seed', range(5))
def test_the_rate_hardly_matters(seed):
    """At 10 Hz and at 100 Hz: the same duration within 3 %."""
    _, slow = random_run(seed, dt=0.1)
    _, fast = random_run(seed, dt=0.01)
    assert slow.duration == pytest.approx(fast.duration, rel=0.03)


def test_laps_are_all_gone():
    square = Route([(0, 0), (4, 0), (4, 4), (0, 4)], laps=3)
    run = predict(square, PARAMETERS, Pose(0.0, 0.0, 0.0))
    crossings = sum(a.y < 2.0 <= b.y and a.x > 2.0 for a, b in pairwise(run.poses))
    assert run.arrived
    assert crossings == 3


def test_a_larger_distance_cuts_corners_more():
    corner = Route([(0, 0), (4, 0), (4, 4)])
    near, far = (
        predict(corner, FollowParameters(virtual_point_distance=d), Pose(0.0, 0.0, 0.0))
        for d in (0.3, 1.0)
    )
    assert near.cross_track(corner)[1] < far.cross_track(corner)[1] < 1.0


def test_how_far_beside_the_route_it_is():
    """Hand calculation: 3, 4 and 0 m off; the mean square is 25/3."""
    route = Route([(0, 0), (10, 0)])
    poses = [Pose(1.0, 3.0, 0.0), Pose(2.0, -4.0, 1.0), Pose(5.0, 0.0, 0.0)]
    off, most = Prediction(0.1, poses, [], 1.0).cross_track(route)
    assert off == pytest.approx(sqrt(25.0 / 3.0))
    assert most == pytest.approx(4.0)


def test_what_holds_it_down_is_told_by_shares_of_the_time():
    """Turning counts for no speed: of four steps one is at the top speed of 0.5 m/s."""
    (first, *_), twists = (
        predict(Route([(0, 0), (4, 0)]), PARAMETERS, Pose(0.0, 0.0, 0.0), longest=0.1).steps,
        [Twist(0.3, 0.0, 0.4), Twist(0.3, 0.4, 0.0), Twist(0.4, 0.0, 0.4), Twist(0.0, 0.2, 1.0)],
    )
    bend = first.limits._replace(limiter=RouteLimiter.BEND)
    steps = [first._replace(twist=twist, limits=bend) for twist in twists]
    run = Prediction(0.1, [], steps, 0.5)
    assert run.held_by() == ['v(alpha)', 'nothing', 'v(alpha)', 'v(alpha)']
    assert run.limiter_shares() == {'v(alpha)': 0.75, 'nothing': 0.25}
    assert next(iter(run.limiter_shares())) == 'v(alpha)'
    assert run.duration == pytest.approx(0.3)


def test_it_starts_from_rest():
    """No time has passed at the start; then the speed joins 0.5 m/s within 0.3 s."""
    run = predict(Route([(0, 0), (20, 0)]), PARAMETERS, Pose(0.0, 0.0, 0.0), 0.1, longest=0.4)
    assert [step.twist.vx for step in run.steps] == pytest.approx([0.0, 1 / 6, 1 / 3, 0.5, 0.5])
    assert [pose.x for pose in run.poses] == pytest.approx([0.0, 0.0, 1 / 60, 0.05, 0.1])


def test_its_commands_are_held_within_its_limits():
    """Fast tables: 120 m/s and 3 rad/s, unless somebody limits them."""
    fast = FollowParameters(
        v_dphi=(0.0, 120.0), v_dn=(0.0, 120.0), v_d=(0.0, 0.0, 1.0, 120.0),
        omega_dphi=(0.0, 0.0, 1.0, 3.0), speed_coupling_ms=0.0, turn_coupling_ms=0.0,
    )  # fmt: skip

    def first(**options):
        start = Pose(0.0, 0.0, 1.0)
        run = predict(Route([(0, 0), (90, 0)]), fast, start, longest=0.01, **options)
        assert run.dt == 0.05
        return run.steps[0].twist

    assert first() == pytest.approx((120.0, 0.0, -3.0))
    assert first(limits=TwistLimits(turn_rate=1.5, wheel_speed=90.0)) == pytest.approx(
        (60.0, 0.0, -1.5)
    )


def test_after_an_hour_a_prediction_is_given_up():
    endless = Route([(0, 0), (4, 0), (4, 4)], laps=0)
    assert predict(endless, PARAMETERS, Pose(0.0, 0.0, 0.0), dt=60.0).duration == 3600.0


def test_on_a_straight_route_it_is_never_beside_it():
    """And most of the time at full speed: 20 m at 0.5 m/s take 40 s, and a little to brake."""
    straight = Route([(0, 0), (20, 0)])
    run = predict(straight, PARAMETERS, Pose(0.0, 0.0, 0.0))
    assert run.cross_track(straight) == (0.0, 0.0)
    assert 40.0 < run.duration < 44.0
    assert next(iter(run.limiter_shares())) == 'nothing'


def test_what_does_not_arrive_is_given_up():
    endless = Route([(0, 0), (4, 0), (4, 4)], laps=0)
    run = predict(endless, PARAMETERS, Pose(0.0, 0.0, 0.0), longest=60.0)
    assert not run.arrived
    assert run.duration == pytest.approx(60.0)
