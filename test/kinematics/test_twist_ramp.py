"""The ramp of a twist, as laws: the limits of every wheel, the straight line, the least time."""

from __future__ import annotations

from itertools import pairwise
from math import ceil, inf, nan, pi, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.omniwheel_placement import OmniWheel
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.twist_ramp import TwistRamp
from agv_motion.kinematics.wheel_limits import WheelLimits
from agv_motion.planar import REST, Twist

DT = 0.02
UP, DOWN, TOP = 1.0, 2.5, 1.0
LIMITS = WheelLimits(TOP, UP, DOWN)
TWO = DifferentialDrive(0.4, [0.05, 0.05]).matrix
THREE = OmniWheels([
    OmniWheel(0.2, 0.0, pi / 2, pi / 2),
    OmniWheel(-0.1, 0.2, 3.6, pi / 2),
    OmniWheel(-0.1, -0.2, -0.5, pi / 2),
]).matrix  # fmt: skip
NUMBERS = st.one_of(st.just(0.0), st.floats(-2.0, 2.0))
FLAT = st.builds(Twist, NUMBERS, st.just(0.0), NUMBERS)
FULL = st.builds(Twist, NUMBERS, NUMBERS, NUMBERS)
MOVES = st.one_of(st.tuples(st.just(TWO), FLAT, FLAT), st.tuples(st.just(THREE), FULL, FULL))


def wheels(rows, twist):
    return [sum(a * b for a, b in zip(row, twist, strict=True)) for row in rows]


def ramp_at(rows, twist, limits=LIMITS):
    """Return a ramp that has come to ``twist``."""
    ramp = TwistRamp(rows, WheelLimits(limits.max_wheel_speed, 0.0, 0.0))
    ramp.set_target(twist)
    ramp.update(1.0)
    settled = TwistRamp(rows, limits)
    settled.twist = settled.target = ramp.twist
    return settled


def run(ramp, target, dts):
    """Return the twists on the way to ``target``, the start first."""
    ramp.set_target(target)
    return [ramp.twist, *(ramp.update(dt) for dt in dts)]


@given(MOVES, st.lists(st.floats(1e-4, 0.2), max_size=40))
def test_no_wheel_is_faster_or_changes_faster_than_it_may(move, dts):
    rows, first, second = move
    twists = run(ramp_at(rows, first), second, dts)
    for before, after, dt in zip(twists, twists[1:], dts, strict=False):
        for a, b in zip(wheels(rows, before), wheels(rows, after), strict=True):
            assert abs(b) <= TOP * (1 + 1e-12)
            if a * b >= 0.0:
                limit = UP if abs(b) > abs(a) else DOWN
                assert abs(b - a) <= limit * dt + 1e-12
            else:  # braking to zero, then speeding up: both take their time
                assert abs(a) / DOWN + abs(b) / UP <= dt + 1e-12


@given(MOVES, st.lists(st.floats(1e-3, 0.2), max_size=20))
def test_the_way_from_twist_to_twist_is_straight_and_never_turns_back(move, dts):
    rows, first, second = move
    ramp = ramp_at(rows, first)
    twists, share = run(ramp, second, dts), 0.0
    start, gap = twists[0], [b - a for a, b in zip(twists[0], ramp.target, strict=True)]
    square = sum(g * g for g in gap)
    for twist in twists:
        moved = [b - a for a, b in zip(start, twist, strict=True)]
        along = sum(m * g for m, g in zip(moved, gap, strict=True)) / square if square else 1.0
        assert share - 1e-9 <= along <= 1.0 + 1e-9
        share = along
        for m, g in zip(moved, gap, strict=True):
            assert m == pytest.approx(along * g, abs=1e-9)


@given(st.sampled_from(['two', 'three']), FULL)
def test_from_rest_and_to_rest_the_least_time_is_that_of_the_fastest_wheel(base, twist):
    rows = TWO if base == 'two' else THREE
    if base == 'two':
        twist = twist._replace(vy=0.0)
    for limit, first, second in ((UP, REST, twist), (DOWN, twist, REST)):
        ramp = ramp_at(rows, first)
        ramp.set_target(second)
        change = max(map(abs, wheels(rows, (ramp.target if first == REST else ramp.twist))))
        steps = 0
        while not ramp.settled:
            ramp.update(DT)
            steps += 1
        assert steps == ceil(change / (limit * DT) * (1 - 1e-9))
        assert ramp.twist == ramp.target


@given(MOVES, st.integers(1, 30))
def test_left_and_right_forward_and_backward_are_alike(move, steps):
    rows, first, second = move
    minus = lambda twist: Twist(*(-number for number in twist))  # noqa: E731
    there = run(ramp_at(rows, first), second, [DT] * steps)
    back = run(ramp_at(rows, minus(first)), minus(second), [DT] * steps)
    for one, other in zip(there, back, strict=True):
        assert other == pytest.approx(minus(one), abs=1e-12)


def test_from_ahead_to_astern_by_hand():
    """0.5 m/s: 0.2 s of braking with 2.5 m/s2, 0.5 s of speeding up with 1 m/s2."""
    twists = run(ramp_at(TWO, Twist(0.5, 0.0, 0.0)), Twist(-0.5, 0.0, 0.0), [0.1] * 7)
    assert [twist.vx for twist in twists] == pytest.approx(
        [0.5, 0.25, 0.0, -0.1, -0.2, -0.3, -0.4, -0.5]
    )


def test_braking_in_a_bend_the_robot_stays_on_its_arc():
    twists = run(ramp_at(TWO, Twist(0.5, 0.0, 1.0)), REST, [DT] * 100)
    moving = [twist for twist in twists if any(twist)]
    assert len(moving) == ceil(0.7 / (DOWN * DT))
    assert all(twist.wz / twist.vx == pytest.approx(2.0) for twist in moving)


def test_what_is_too_fast_is_scaled_as_a_whole():
    twists = run(TwistRamp(TWO, LIMITS), Twist(3.0, 0.0, 5.0), [DT] * 200)
    assert twists[-1] == pytest.approx((0.75, 0.0, 1.25))


def test_stopped_for_safety_it_is_at_rest_at_once_and_starts_from_there():
    ramp = ramp_at(TWO, Twist(0.8, 0.0, 0.0))
    ramp.stop()
    assert ramp.twist == REST
    assert ramp.settled
    ramp.set_target(Twist(0.8, 0.0, 0.0))
    assert ramp.update(DT).vx == pytest.approx(UP * DT)


def test_without_limits_the_target_is_reached_in_one_step():
    ramp = TwistRamp(THREE, WheelLimits(TOP, 0.0, 0.0))
    ramp.set_target(Twist(0.1, 0.2, 0.3))
    assert ramp.update(1e-6) == (0.1, 0.2, 0.3)


JERKY = WheelLimits(TOP, UP, DOWN, 8.0)


@given(MOVES)
def test_with_a_limit_of_jerk_it_is_held_from_steady_to_steady_and_the_way_stays_straight(move):
    rows, first, second = move
    ramp = ramp_at(rows, first, JERKY)
    twists = run(ramp, second, [DT] * 200)
    assert twists[-1] == ramp.target
    speeds = [wheels(rows, twist) for twist in [twists[0], *twists, twists[-1]]]
    slopes = [[(b - a) / DT for a, b in zip(*pair, strict=True)] for pair in pairwise(speeds)]
    for before, after in pairwise(slopes):
        for a, b in zip(before, after, strict=True):
            assert abs(b - a) <= 8.0 * DT * (1 + 1e-6) + 1e-9
            assert abs(b) <= DOWN * (1 + 1e-9)
    gap = [b - a for a, b in zip(twists[0], ramp.target, strict=True)]
    square = sum(g * g for g in gap)
    for twist in twists:
        moved = [b - a for a, b in zip(twists[0], twist, strict=True)]
        along = sum(m * g for m, g in zip(moved, gap, strict=True)) / square if square else 1.0
        assert -1e-9 <= along <= 1.0 + 1e-9
        assert moved == pytest.approx([along * g for g in gap], abs=1e-9)


def test_with_a_limit_of_jerk_the_time_is_that_of_the_s_curve():
    """0.5 m/s with 1 m/s2 and 8 m/s3: 0.5 / 1 + 1 / 8 s; 0.1 m/s never reaches 1 m/s2."""
    for change, expected in ((0.5, 0.5 + 1.0 / 8.0), (0.1, 2.0 * sqrt(0.1 / 8.0))):
        ramp, time = TwistRamp(TWO, JERKY), 0.0
        ramp.set_target(Twist(change, 0.0, 0.0))
        while not ramp.settled:
            ramp.update(0.001)
            time += 0.001
        assert time == pytest.approx(expected, abs=0.004)


@given(st.lists(st.tuples(FULL, st.lists(st.floats(0.005, 0.05), max_size=15)), max_size=5))
def test_however_the_target_changes_no_wheel_is_too_fast_and_the_last_one_is_reached(orders):
    ramp = TwistRamp(THREE, JERKY)
    for target, dts in orders:
        for twist in run(ramp, target, dts):
            assert max(map(abs, wheels(THREE, twist))) <= TOP * (1 + 1e-9)
    for _ in range(1000):
        ramp.update(DT)
    assert ramp.settled


@pytest.mark.parametrize('bad', [nan, inf, -0.1])
def test_what_is_no_time_and_no_twist_is_refused(bad):
    ramp = TwistRamp(TWO, LIMITS)
    with pytest.raises(SignalError, match='dt = '):
        ramp.update(bad)
    if bad != -0.1:
        with pytest.raises(SignalError, match='twist'):
            ramp.set_target(Twist(bad, 0.0, 0.0))
    with pytest.raises(SignalError, match='look at the units'):
        ramp.set_target(Twist(1.7e308, 0.0, 1.7e308))
    assert ramp.target == REST
