"""How much of a change all turrets can follow, and the quick answer where it is all of it."""

from __future__ import annotations

from math import cos, pi, sin, tan

import numpy as np
import pytest
from hypothesis import given
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


def wheels_and_changes(chassis, direction, change):
    """Return (3,) velocity of each wheel, and how it changes, as complex numbers."""
    (a, b, c), (va, vb, vc), arms = direction, change, np.array(chassis.arms)
    x, y = arms.T
    return a - c * y + 1j * (b + c * x), va - vc * y + 1j * (vb + vc * x)


def chosen(seed):
    """Return a platform on three turrets, a wanted velocity, and a random number."""
    chance = np.random.default_rng(seed)
    direction = chance.normal(size=3)
    direction /= np.hypot.reduce(direction)
    velocity, target = 0.5 * chance.normal(size=3), 2.0 * chance.normal(size=3)
    limits = SteeringLimits(steering_rate=2.0, steering_acceleration=4.0)
    rolling = Rolling(AtRest.at([0.0] * 3).setpoints, Stance(tuple(direction), [1.0] * 3))
    rolling.velocity = tuple(velocity)
    chassis = measure(CORNERS, limits)
    wheels, changes = wheels_and_changes(chassis, direction, velocity)
    rolling.setpoints.rates = ((changes / wheels).imag + 0.3 * chance.normal(size=3)).tolist()
    return chassis, rolling, tuple(target)


def test_the_longest_share_is_that_of_a_search_over_all():
    """The turn of each wheel in a step of 0.1 s, by its own angle, for each of 4001 shares."""
    shares, found = np.linspace(0.0, 1.0, 4001)[:, None], []
    for seed in range(60):
        chassis, rolling, target = chosen(seed)
        rates = np.array(rolling.setpoints.rates)
        wheels, now = wheels_and_changes(chassis, rolling.direction, rolling.velocity)
        _, then = wheels_and_changes(chassis, rolling.direction, target)
        turns = np.angle((wheels + 0.1 * (now + shares * (then - now))) / wheels) / 0.1
        least, most = rates - 0.4, rates + 0.4
        most = np.where(most > 2.0, np.maximum(least, 2.0), most)
        least = np.where(least < -2.0, np.minimum(most, -2.0), least)
        may = np.all((least <= turns) & (turns <= most), axis=1)
        share = longest_share(chassis, rolling, target, 0.1)
        if may.any():
            assert share == pytest.approx(shares[may].max(), abs=3e-4), seed
        else:
            assert share is None, seed
        found.append(share)
    assert 10 < found.count(None) < 40


def test_braking_is_certain_by_the_turn_and_the_nearing_of_the_fastest_wheel():
    for seed in range(20):
        chassis, rolling, velocity = chosen(seed)
        wheels, changes = wheels_and_changes(chassis, rolling.direction, velocity)
        ratio = changes / wheels
        nearing = max(np.hypot.reduce(velocity), *-ratio.real)
        enough = 4.0 * nearing * np.abs(ratio.imag).max()
        for share in (0.99, 1.01):
            limits = SteeringLimits(steering_acceleration=share * enough)
            assert can_brake(measure(CORNERS, limits), rolling, velocity) == (share > 1.0)


@pytest.mark.parametrize(('rate', 'share'), [(0.5, 1.0), (1.0, None), (0.0, None)])
@pytest.mark.parametrize('side', [1.0, -1.0])
def test_a_velocity_that_stays_is_followed_or_is_not(rate, share, side):
    """0.5 rad/s, of turrets that turn already, too fast to slow down to it, or not yet."""
    velocity = (0.0, 0.5 * side, 0.0)
    platform = moving(velocity, rates=(rate * side, rate * side))
    assert longest_share(*platform, velocity, 0.1) == share


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
