"""How much of a change all turrets can follow, and the quick answer where it is all of it."""

from __future__ import annotations

from math import cos, pi, sin, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.follow import (
    all_follow,
    can_brake,
    longest_share,
    nearest_velocity,
)
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest, Rolling, Stance
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Twist

CORNERS = Turrets([(cos(a), sin(a)) for a in (-pi / 3, pi / 3, pi)])
LIMITS = SteeringLimits()


@settings(max_examples=100)
@given(st.integers(0, 10**6))
def test_all_follow_just_where_the_longest_share_is_the_whole(seed):
    chance = np.random.default_rng(seed)
    planner, phase = SteeringPlanner(CORNERS, LIMITS), AtRest.at([0.0] * 3)
    chassis = measure(CORNERS, LIMITS)
    heading, spin = chance.uniform(-pi, pi), 0.0
    for _ in range(150):
        heading, spin = heading + chance.normal(0.0, 0.03), spin + chance.normal(0.0, 2e-4)
        phase = planner.step(phase, Twist(0.01 * cos(heading), 0.01 * sin(heading), spin), 0.1)
        if not isinstance(phase, Rolling):
            continue
        size = 10.0 ** chance.uniform(-3.0, 0.0)
        target = tuple(size * chance.uniform(-1.0, 1.0) for _ in range(3))
        share = longest_share(chassis, phase, target, 0.1)
        assert all_follow(chassis, phase, target, 0.1) == (share == 1.0)


PAIR = Turrets([(1.0, 0.0), (-1.0, 0.0)])


def moving(velocity, direction=(1.0, 0.0, 0.0), rates=(0.0, 0.0), acceleration=4.0):
    """Return a platform whose direction turns, and what it can do: 2 rad/s at so much."""
    rolling = Rolling(AtRest.at([0.0, 0.0]).setpoints, Stance(direction, [1.0, 1.0]))
    rolling.velocity, rolling.setpoints.rates = velocity, list(rates)
    limits = SteeringLimits(steering_rate=2.0, steering_acceleration=acceleration)
    return measure(PAIR, limits), rolling


@pytest.mark.parametrize(
    ('before', 'target', 'after'),
    [(1.0, -1.0, 0.6), (1.0, 0.3, 0.6), (0.2, 3.0, 0.6), (-0.2, -3.0, -0.6), (1.0, 3.0, 0.6)],
)
def test_a_rate_changes_by_no_more_than_the_acceleration(before, target, after):
    """Hand calculation: 4 rad/s2 in 0.1 s; a translation turns all turrets alike.

    At 1.4 rad/s braking would not be certain, so from 1 rad/s it brakes.
    """
    platform = moving((0.0, before, 0.0), rates=(before, before))
    found = nearest_velocity(*platform, (0.0, target, 0.0), 0.1)
    assert found.velocity == pytest.approx((0.0, tan(0.1 * after) / 0.1, 0.0), rel=1e-5)
    assert not found.whole


def test_a_change_within_reach_is_made_whole():
    found = nearest_velocity(*moving((0.0, 0.9, 0.0), rates=(0.9, 0.9)), (0.0, 1.0, 0.0), 0.1)
    assert found == ((0.0, pytest.approx(1.0), 0.0), True)


def test_where_it_cannot_turn_aside_so_soon_it_brakes_straight_on():
    """From 1.9 rad/s only 1.5 can be reached: too much to be certain of braking after an aside."""
    found = nearest_velocity(*moving((0.0, 1.9, 0.0), rates=(1.9, 1.9)), (0.0, 1.9, 0.5), 0.1)
    assert found.velocity == pytest.approx((0.0, tan(0.15) / 0.1, 0.0), rel=1e-5)
    assert not found.whole


@pytest.mark.parametrize(
    ('rate', 'least', 'most'),
    [(0.9, 0.5, 1.3), (-0.9, -1.3, -0.5), (0.1, -0.3, 0.5), (1.9, 1.5, 2.0), (-1.9, -2.0, -1.5)],
)
def test_all_follow_within_what_rate_and_acceleration_allow(rate, least, most):
    """Hand calculation: 2 rad/s, and 0.4 rad/s more or less in a step."""
    platform = moving((0.0, rate, 0.0), rates=(rate, rate))
    for turn, may in ((least - 0.01, False), (least + 0.01, True), (most - 0.01, True),
                      (most + 0.01, False)):  # fmt: skip
        target = (0.0, tan(0.1 * turn) / 0.1, 0.0)
        assert all_follow(*platform, target, 0.1) == may
        assert (longest_share(*platform, target, 0.1) == 1.0) == may


@pytest.mark.parametrize('side', [1.0, -1.0])
def test_in_a_long_step_no_turret_turns_by_more_than_69_degrees(side):
    """1.2 rad, of the 2 that a second would allow: tan(1.2) of 4."""
    platform = moving((0.0, 0.0, 0.0), acceleration=100.0)
    assert longest_share(*platform, (0.0, 4.0 * side, 0.0), 1.0) == pytest.approx(tan(1.2) / 4.0)


def test_where_no_turret_can_follow_the_direction_stands_at_once():
    """They turn to the right while the direction goes left: neither braking keeps the limits."""
    found = nearest_velocity(*moving((0.0, 1.0, 0.0), rates=(-1.0, -1.0)), (0.0, 1.1, 0.0), 0.1)
    assert found == ((0.0, 0.0, 0.0), False)


def test_turrets_that_turn_against_each_other_cannot_follow_a_translation():
    chassis, rolling = moving((0.0, 0.0, 0.0), rates=(1.0, -1.0))
    assert longest_share(chassis, rolling, (0.0, 1.0, 0.0), 0.1) is None
    assert not all_follow(chassis, rolling, (0.0, 1.0, 0.0), 0.1)


@pytest.mark.parametrize(
    ('velocity', 'direction', 'enough'),
    [
        # both turrets turn at 0.1 rad/s and near nothing: 4 * 0.1 * 0.1
        ((0.1, 0.0, 0.0), (0.0, 1.0, 0.0), 0.04),
        ((0.0, -0.1, 0.0), (1.0, 0.0, 0.0), 0.04),
        # the second wheel moves at 0.2, turns at 0.02 / 0.04 and vanishes at 0.028 / 0.04
        ((0.1, -0.06, 0.08), (0.0, 0.8, 0.6), 1.4),
    ],
)
def test_braking_is_certain_up_to_a_quarter_of_the_acceleration(velocity, direction, enough):
    for share in (0.99, 1.01):
        chassis, rolling = moving(velocity, direction, acceleration=share * enough)
        assert can_brake(chassis, rolling, velocity) == (share > 1.0)
