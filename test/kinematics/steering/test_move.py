"""How fast the direction of the twist may turn. Hand calculations: translations turn all alike."""

from __future__ import annotations

from math import atan2, cos, hypot, inf, pi, sin, sqrt, tan

import pytest

from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.move import (
    HERE,
    TOO_FAR,
    TURNING,
    _bounded,
    _Demand,
    is_slow,
    plan_move,
)
from agv_motion.kinematics.steering.state import AtRest, Limiter, Rolling, Stance
from agv_motion.kinematics.turrets import Turrets

PAIR = Turrets([(0.5, 0.0), (-0.5, 0.0)])
AHEAD = (1.0, 0.0, 0.0)
FAST = {'steering_rate': 2.0, 'steering_acceleration': 1000.0, 'wheel_acceleration': 100.0}


def plan(wanted, period=0.1, direction=AHEAD, speed=0.1, angles=(0.0, 0.0), **limits):
    chassis = measure(PAIR, SteeringLimits(**(FAST | limits)))
    rolling = Rolling(AtRest.at(angles).setpoints, Stance(direction, [1.0, 1.0]))
    rolling.speed = speed
    return plan_move(chassis, rolling, wanted, period)


def left(angle):
    return cos(angle), sin(angle), 0.0


def test_nothing_is_to_be_done_where_the_direction_is_the_wanted_one():
    assert plan(AHEAD) is HERE
    assert plan((-1.0, 0.0, 0.0)) is TOO_FAR


@pytest.mark.parametrize('side', [1.0, -1.0])
def test_the_turrets_turn_as_fast_as_they_may(side):
    move = plan(left(side))
    assert move.velocity == pytest.approx((0.0, 2.0 * side, 0.0))
    assert (move.arrives, move.limiter, move.free) == (False, Limiter.STEERING_RATE, ())


def test_the_last_step_ends_at_the_wanted_direction():
    move = plan(left(0.1))
    assert move.velocity == pytest.approx((0.0, tan(0.1) / 0.1, 0.0))
    assert (move.arrives, move.limiter) == (True, Limiter.NONE)


def test_who_stays_arrives_nowhere():
    assert [move.arrives for move in (HERE, TURNING, TOO_FAR)] == [False] * 3


EASY = _Demand(AHEAD, 3.0, 1.0, 1.0, 0.0, 0.0, 0.0, -inf, lands_turning=False, free=())


@pytest.mark.parametrize(
    ('asked', 'period', 'limits', 'rate', 'limiter'),
    [
        ({}, 0.1, {}, 2.0, Limiter.STEERING_RATE),
        ({'turning': 4.0}, 0.1, {}, 0.5, Limiter.STEERING_RATE),
        # an eighth of 8 rad/s2, and a quarter where the wheel speeds up
        ({'turning': 2.0}, 0.1, {'steering_acceleration': 8.0}, sqrt(1 / 2), 'acceleration'),
        ({'nearing': 4.0}, 0.1, {'steering_acceleration': 8.0}, sqrt(1 / 4), 'acceleration'),
        ({'receding': 9.0}, 0.1, {'steering_acceleration': 8.0}, sqrt(2 / 9), 'acceleration'),
        # two fifths of 1 m/s2 at 5 m/s, of wheels that gain 2 for each
        ({'growing': 4.0}, 0.1, {'wheel_acceleration': 1.0}, 0.4 / 5.0 / 2.0, 'wheels'),
        # the same within 0.1 s, of wheels that gain nothing yet, but 2 for the square of each
        ({'bending': 4.0}, 0.1, {'wheel_acceleration': 1.0}, sqrt(0.4 / 5.0 / 0.1), 'wheels'),
        # half a radian in a step, and half of the velocity of a wheel, unless it shall vanish
        ({}, 1.0, {}, 0.5, Limiter.STEERING_RATE),
        ({'nearing': 2.0}, 0.3, {}, 0.25 / 0.3, Limiter.STEERING_RATE),
        ({'nearing': 2.0}, 0.2, {}, 0.25 / 0.2, Limiter.STEERING_RATE),
        ({'nearing': 2.0, 'landing': 1.2}, 0.2, {}, 0.25 / 0.2, Limiter.STEERING_RATE),
        ({'nearing': 2.0, 'landing': 1.3}, 0.2, {}, 2.0, Limiter.STEERING_RATE),
    ],
)
def test_each_limit_has_its_share_of_what_there_is(asked, period, limits, rate, limiter):
    """At 2 rad/s, 1000 rad/s2 and 100 m/s2 but for what is told."""
    found = _bounded(SteeringLimits(**(FAST | limits)), 5.0, EASY._replace(**asked), period)
    assert found.velocity == pytest.approx((rate, 0.0, 0.0))
    words = {
        'acceleration': Limiter.STEERING_ACCELERATION,
        'wheels': Limiter.WHEEL_ACCELERATION,
    }
    assert found.limiter is words.get(limiter, limiter)
    assert not found.arrives


def test_the_acceleration_limits_the_rate():
    """An eighth of it over one radian: 1 rad/s at 8 rad/s2."""
    move = plan(left(1.4), steering_acceleration=8.0)
    assert move.velocity == pytest.approx((0.0, 1.0, 0.0))
    assert move.limiter is Limiter.STEERING_ACCELERATION


def test_it_brakes_in_time():
    """Half of 8 rad/s2 over 0.05 rad in steps of 0.02 s: 4 (sqrt(0.01**2 + 0.1 / 4) - 0.01)."""
    move = plan(left(0.05), period=0.02, steering_acceleration=8.0)
    assert move.velocity[1] == pytest.approx(4.0 * (sqrt(1e-4 + 0.025) - 0.01))
    assert move.limiter is Limiter.STEERING_ACCELERATION
    assert not move.arrives


def test_wheels_that_speed_up_limit_it():
    """From forward into a turn about a point 0.5 m aside one wheel gains all that the other loses.

    At 1 m/s and a wheel acceleration of 1 m/s2, of which 0.4 are for turning.
    """
    move = plan(
        (0.0, cos(0.5), sin(0.5)), direction=(0.0, 1.0, 0.0), speed=1.0, wheel_acceleration=1.0,
        angles=(pi / 2, pi / 2),
    )  # fmt: skip
    assert move.velocity == pytest.approx((0.0, 0.0, 0.4))
    assert move.limiter is Limiter.WHEEL_ACCELERATION


def test_a_wheel_at_the_centre_of_rotation_speeds_up_along_its_line():
    """Its velocity is nought and grows by (1, 2) / sqrt(3) for each radian: sqrt(5 / 3) m/s."""
    half, third = sqrt(0.5), sqrt(1 / 3)
    wanted = (sin(0.5) * third, cos(0.5) * half + sin(0.5) * third,
              cos(0.5) * half - sin(0.5) * third)  # fmt: skip
    move = plan(
        wanted, direction=(0.0, half, half), speed=1.0, wheel_acceleration=1.0,
        angles=(pi / 2, 0.0),
    )  # fmt: skip
    assert move.velocity == pytest.approx(
        tuple(0.4 / sqrt(5 / 3) * share for share in (third, third, -third))
    )
    assert move.limiter is Limiter.WHEEL_ACCELERATION
    assert move.free == ((1, pytest.approx(atan2(2.0, 1.0))),)


@pytest.mark.parametrize(('rate', 'arrives'), [(49.0, True), (-51.0, False), (51.0, False)])
def test_a_turret_at_which_the_centre_of_rotation_comes_to_lie_must_be_able_to_stop(rate, arrives):
    """Half of 1000 rad/s2 over 0.1 s are 50 rad/s; the centre comes from 0.1 rad away."""
    half, near = sqrt(0.5), 0.1
    before = (sin(near), cos(near) * half, cos(near) * half)
    chassis = measure(PAIR, SteeringLimits(**FAST))
    setpoints = AtRest.at((pi / 2, 0.0)).setpoints
    setpoints.rates[1] = rate
    rolling = Rolling(setpoints, Stance(before, [1.0, 1.0]))
    rolling.speed = 0.1
    move = plan_move(chassis, rolling, (0.0, half, half), 0.1)
    assert move.arrives is arrives
    if not arrives:  # half of the way, and as much again in each step that follows
        assert hypot(*move.velocity) == pytest.approx(0.05 / 0.1)


@pytest.mark.parametrize(('angle', 'far'), [(1.7, False), (1.8, True), (-1.7, False), (-1.8, True)])
def test_a_turret_that_would_turn_further_had_better_be_reversed(angle, far):
    """A quarter turn and the hysteresis of 0.2 rad are 1.77 rad; a stop once begun goes by less."""
    assert (plan(left(angle)) is TOO_FAR) == far


def test_a_stop_once_begun_is_reconsidered_within_the_reversal_angle_only():
    chassis = measure(PAIR, SteeringLimits(**FAST))
    rolling = Rolling(AtRest.at([0.0, 0.0]).setpoints, Stance(AHEAD, [1.0, 1.0]))
    rolling.stopping = True
    assert plan_move(chassis, rolling, left(1.6), 0.1) is TOO_FAR
    assert plan_move(chassis, rolling, left(1.5), 0.1) is not TOO_FAR


@pytest.mark.parametrize(('angle', 'far'), [(9.3, True), (9.2, False), (-9.3, False)])
def test_no_turret_leaves_its_cables(angle, far):
    move = plan(left(0.17), angles=(angle, 0.0), direction=AHEAD)
    assert (move is TOO_FAR) == far


def test_a_turret_at_the_centre_of_rotation_is_named_with_its_line():
    half = sqrt(0.5)
    move = plan((0.0, -half, half), direction=(0.0, half, half), angles=(pi / 2, 0.0))
    assert move.free == ((1, pytest.approx(-pi / 2)),)


@pytest.mark.parametrize(
    ('rate', 'slow'), [(0.19, True), (-0.19, True), (0.21, False), (-0.21, False)]
)
def test_slow_is_what_stops_within_a_step(rate, slow):
    """Half of 4 rad/s2 over 0.1 s."""
    told = AtRest.at([0.0, 0.0]).setpoints
    told.rates[1] = rate
    assert is_slow(told, SteeringLimits(steering_acceleration=4.0), 1, 0.1) == slow
