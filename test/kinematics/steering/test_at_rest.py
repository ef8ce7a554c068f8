"""Turrets at rest: goals along their lines, within the cables; a stance is one that is reached."""

from __future__ import annotations

from itertools import product
from math import cos, pi, sin, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.kinematics.steering.at_rest import (
    FREE_CHANGES,
    align,
    choose_goals,
    hold,
    may_roll,
    unwind,
)
from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.state import BACKWARDS, AtRest, Limiter, Stance
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import wrap

PAIR = Turrets([(0.5, 0.0), (-0.5, 0.0)])
LIMITS = SteeringLimits(steering_rate=2.0, steering_acceleration=4.0)
CHASSIS = measure(PAIR, LIMITS)


def towards(heading):
    """Return the direction of a translation."""
    return cos(heading), sin(heading), 0.0


@given(
    st.floats(-12.0, 12.0), st.floats(-pi, pi), st.floats(0.3, 2.0), st.floats(pi / 2, pi)
)  # fmt: skip
def test_a_goal_is_the_nearest_along_the_line_forwards_up_to_the_reversal_angle(
    angle, heading, turns, reversal
):
    chassis = measure(PAIR, SteeringLimits(turn_limit=turns, reversal_angle=reversal))
    rest, most = AtRest.at([angle, 0.0]), turns * tau
    goals = choose_goals(chassis, rest.setpoints, towards(heading))
    goal, sign = goals.angles[0], goals.signs[0]
    assert abs(goal) <= most
    assert cos(goal - heading) * sign == pytest.approx(1.0)
    near = min(max(angle, -most), most)
    ways = [
        (s < 0.0 or abs(other - angle) > reversal, abs(other - angle))
        for s, k in product((1.0, -1.0), range(-5, 6))
        for other in [heading + (pi if s < 0.0 else 0.0) + k * tau]
        if abs(other) <= most and abs(other - near) <= tau
    ]
    chosen = sign < 0.0 or abs(goal - angle) > reversal, abs(goal - angle)
    assert chosen[0] == min(ways)[0] or abs(chosen[1] - reversal) < 1e-9
    assert chosen[1] <= min(way for late, way in ways if late == chosen[0]) + 1e-9


@pytest.mark.parametrize('turns', [0.3, 1.5])
@pytest.mark.parametrize('side', [-1.0, 1.0])
def test_a_turret_at_the_end_of_its_cables_reverses_its_wheel_where_it_stands(side, turns):
    """Whatever the last digit of the way back: it neither turns round nor goes a digit too far."""
    end = side * turns * tau
    chassis = measure(PAIR, SteeringLimits(turn_limit=turns))
    for k in range(-3, 4):
        wanted = towards(wrap(end + pi) + k * 4e-16)
        goals = choose_goals(chassis, AtRest.at([end, end]).setpoints, wanted)
        assert goals.angles == pytest.approx([end, end], abs=1e-12)
        assert max(map(abs, goals.angles)) <= turns * tau
        assert goals.signs == [BACKWARDS, BACKWARDS]


def test_a_wheel_that_does_not_move_stays_or_comes_back_within_its_limit():
    about = measure(Turrets([(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0)]), LIMITS)
    rest = AtRest.at([0.4, 0.0, 0.0])
    rest.setpoints.signs[0] = -1.0
    goals = choose_goals(about, rest.setpoints, (0.0, 0.0, 1.0))
    assert (goals.angles[0], goals.signs[0]) == (0.4, -1.0)
    assert choose_goals(about, AtRest.at([20.0, 0.0, 0.0]).setpoints, (0.0, 0.0, 1.0)).angles[
        0
    ] == pytest.approx(1.5 * tau)


def test_turrets_that_turn_are_brought_to_a_stop_and_have_no_stance():
    rest = AtRest.at([0.0, 0.0])
    rest.stance = Stance(towards(0.0), [1.0, 1.0])
    hold(rest, LIMITS, 0.1)
    assert rest.stance is not None
    rest.setpoints.rates = [1.0, 0.3]
    hold(rest, LIMITS, 0.1)
    assert rest.setpoints.rates == pytest.approx([0.6, 0.0])
    assert rest.setpoints.angles == pytest.approx([0.06, 0.0])
    assert rest.stance is None
    hold(rest, LIMITS, 0.1)  # also while one of them stands
    assert rest.setpoints.rates == pytest.approx([0.2, 0.0])
    assert rest.setpoints.angles == pytest.approx([0.08, 0.0])


def test_alignment_ends_in_the_stance_that_was_asked_for():
    rest, wanted, steps = AtRest.at([0.0, 3.0]), towards(1.0), 0
    while rest.stance is None:
        align(CHASSIS, rest, wanted, 0.1)
        assert rest.setpoints.limiter is Limiter.ALIGNING
        steps += 1
    assert rest.setpoints.angles == pytest.approx([1.0, 1.0 + pi])
    assert rest.setpoints.signs == [1.0, -1.0]
    assert rest.stance == (wanted, pytest.approx([1.0, 1.0]))
    assert rest.goals is None
    assert rest.changes == 0
    assert 10 < steps < 25


def test_lengths_of_a_stance_are_the_speeds_of_the_wheels():
    """Hand calculation: 0.6 forward and 0.8 of rotation; the wheels stand one length off."""
    rest, wanted = AtRest.at([0.0, 0.0]), (0.6, 0.0, 0.8)
    while rest.stance is None:
        align(CHASSIS, rest, wanted, 0.1)
    assert rest.stance.lengths == pytest.approx([1.0, 1.0])
    while rest.stance is None or rest.stance.direction != (0.0, 0.6, 0.8):
        align(CHASSIS, rest, (0.0, 0.6, 0.8), 0.1)
    assert rest.stance.lengths == pytest.approx([1.4, 0.2])


def test_goals_that_change_too_often_are_kept_until_they_are_reached():
    rest = AtRest.at([0.0, 0.0])
    for i in range(FREE_CHANGES + 1):
        align(CHASSIS, rest, towards(0.5 + 0.2 * i), 0.01)
        assert rest.goals.direction == towards(0.5 + 0.2 * i)
    align(CHASSIS, rest, towards(1.5), 0.01)
    assert rest.goals.direction == towards(0.5 + 0.2 * FREE_CHANGES)
    align(CHASSIS, rest, towards(0.2), 0.01)
    assert rest.goals.direction == towards(0.2)  # a nearer one is as welcome as before


@pytest.mark.parametrize(('other', 'kept'), [(0.15, False), (0.6, True)])
def test_which_goals_are_farther_the_turret_says_that_has_to_turn_most(other, kept):
    """One turret stands 0.3 rad on: for 0.35 rad the first has farthest to go, and it decides."""
    rest = AtRest.at([0.0, 0.3])
    for i in range(FREE_CHANGES + 1):
        align(CHASSIS, rest, towards(0.6 + 0.2 * (i % 2)), 1e-6)
    align(CHASSIS, rest, towards(0.35), 1e-6)
    align(CHASSIS, rest, towards(other), 1e-6)
    assert rest.goals.direction == towards(0.35 if kept else other)


def test_goals_of_unwinding_are_no_stance():
    """However often the goals have changed: turrets that are unwound stand for no direction."""
    rest = AtRest.at([0.4, 3.0])
    for i in range(FREE_CHANGES + 1):
        align(CHASSIS, rest, towards(0.5 + 0.2 * i), 0.01)
    hold(rest, LIMITS, 0.01)
    assert not unwind(rest, LIMITS, 0.01)
    assert rest.goals.direction is None
    align(CHASSIS, rest, towards(1.4), 0.01)
    assert rest.goals.direction == towards(1.4)
    assert rest.changes == FREE_CHANGES + 1


def test_unwinding_takes_no_goals_of_alignment():
    rest = AtRest.at([0.4, 0.4])
    align(CHASSIS, rest, towards(1.2), 0.1)
    while not unwind(rest, LIMITS, 0.1):
        assert rest.goals.angles == pytest.approx([rest.goals.angles[0]] * 2)
        assert rest.setpoints.limiter is Limiter.UNWINDING
    assert rest.setpoints.angles == pytest.approx([0.44, 0.44])
    assert rest.goals is None
    assert rest.setpoints.limiter is Limiter.NONE


@pytest.mark.parametrize(('off', 'may'), [(0.16, True), (0.18, False)])
def test_near_the_stance_the_rest_is_steered_while_rolling(off, may):
    rest = AtRest.at([0.0, 0.0])
    assert not may_roll(CHASSIS, rest, towards(0.0))
    rest.stance = Stance(towards(0.0), [1.0, 1.0])
    assert may_roll(CHASSIS, rest, towards(off)) == may_roll(CHASSIS, rest, towards(-off)) == may


@pytest.mark.parametrize(
    ('angle', 'sign', 'off', 'may'),
    [
        (3 * pi - 0.05, -1.0, 0.1, False),
        (3 * pi - 0.05, -1.0, -0.1, True),
        (0.05 - 3 * pi, -1.0, -0.1, False),
        (0.05 - 3 * pi, -1.0, 0.1, True),
        (3 * pi - 0.2, -1.0, 0.1, True),
        (2 * pi + 0.1, 1.0, 0.1, True),
        (3 * pi - 0.05, 1.0, 0.1, False),
        (3 * pi - 0.05, 1.0, -0.1, True),
        (0.05 - 3 * pi, 1.0, -0.1, False),
        (0.05 - 3 * pi, 1.0, 0.1, True),
    ],
)
def test_no_turret_leaves_its_cables_on_the_way(angle, sign, off, may):
    """One and a half turns are 3 pi."""
    rest = AtRest.at([angle, 0.0])
    heading = angle if sign > 0.0 else angle - pi
    rest.setpoints.signs[0] = sign
    rest.stance = Stance(towards(heading), [1.0, 1.0])
    assert may_roll(CHASSIS, rest, towards(heading + off)) == may
