"""The whole robot's limits: never passed, the centre of rotation stays, a zero passes at once."""

from __future__ import annotations

from math import hypot, inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.arbitration.chassis_limits import ChassisLimitParameters, ChassisLimits
from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.planar import REST, Twist

LIMITS = st.builds(ChassisLimitParameters, *[st.just(0.0) | st.floats(0.01, 10.0)] * 6)
SPEEDS = st.floats(-20.0, 20.0)
TWISTS = st.builds(Twist, SPEEDS, SPEEDS, SPEEDS)
ROUNDING = 1e-9


def limited(wanted, dt=1.0, **given):
    return ChassisLimits(ChassisLimitParameters(**given)).apply(wanted, dt)


@pytest.mark.parametrize(
    ('given', 'passes'),
    [
        ({}, (3.0, 4.0, 2.0)),
        ({'linear_speed': 5.0, 'lateral_speed': 4.0, 'turn_rate': 2.0}, (3.0, 4.0, 2.0)),
        ({'linear_speed': 2.5}, (1.5, 2.0, 1.0)),
        ({'lateral_speed': 1.0}, (0.75, 1.0, 0.5)),
        ({'turn_rate': 0.5}, (0.75, 1.0, 0.5)),
        ({'linear_speed': 2.5, 'turn_rate': 0.5}, (0.75, 1.0, 0.5)),
        ({'linear_acceleration': 2.5}, (1.5, 2.0, 1.0)),
        ({'lateral_acceleration': 1.0}, (0.75, 1.0, 0.5)),
        ({'turn_acceleration': 0.5}, (0.75, 1.0, 0.5)),
    ],
)
def test_worked_cases_after_one_second_from_rest(given, passes):
    assert limited(Twist(3.0, 4.0, 2.0), **given) == pytest.approx(passes)
    assert limited(Twist(-3.0, -4.0, -2.0), **given) == pytest.approx([-x for x in passes])


def test_another_driver_is_taken_up_by_the_ramp_and_exactly():
    limits = ChassisLimits(ChassisLimitParameters(linear_acceleration=1.0))
    limits.apply(Twist(0.5, 0.0, 0.0), 0.5)
    assert limits.settled
    target = Twist(-0.25, 0.0, 0.1)
    assert limits.apply(target, 0.25) == pytest.approx((0.25, 0.0, 0.1 / 3.0))
    assert not limits.settled
    limits.apply(target, 0.25)
    assert limits.apply(target, 0.26) == target
    assert limits.settled


def test_a_zero_passes_at_once_and_then_it_begins_from_rest():
    limits = ChassisLimits(ChassisLimitParameters(linear_acceleration=1.0))
    fast = Twist(5.0, 0.0, 0.0)
    limits.apply(fast, 5.0)
    assert limits.apply(REST, 0.0) == REST
    assert limits.apply(fast, 0.5) == (0.5, 0.0, 0.0)
    assert limits.stop() == limits.twist == limits.target == REST


@given(LIMITS, st.lists(st.tuples(TWISTS, st.floats(0.0, 0.5)), min_size=1, max_size=8))
def test_laws(given, asked):
    limits, last = ChassisLimits(given), REST
    for wanted, dt in asked:
        twist = limits.apply(wanted, dt)
        assert hypot(twist.vx, twist.vy) <= (given.linear_speed or inf) + ROUNDING
        assert abs(twist.vy) <= (given.lateral_speed or inf) + ROUNDING
        assert abs(twist.wz) <= (given.turn_rate or inf) + ROUNDING
        if wanted == REST:
            assert twist == REST
        else:
            step = hypot(twist.vx - last.vx, twist.vy - last.vy)
            assert step <= (given.linear_acceleration or inf) * dt + ROUNDING or dt == 0.0
            if dt:
                assert abs(twist.vy - last.vy) <= (given.lateral_acceleration or inf) * dt + 1e-9
                assert abs(twist.wz - last.wz) <= (given.turn_acceleration or inf) * dt + ROUNDING
            assert limits.target.vx * wanted.vy == pytest.approx(limits.target.vy * wanted.vx)
            assert limits.target.vx * wanted.wz == pytest.approx(limits.target.wz * wanted.vx)
        last = twist


@given(TWISTS)
def test_without_limits_it_is_the_same_to_the_bit(twist):
    assert limited(twist, 0.0) == twist


@pytest.mark.parametrize('number', [nan, inf, -inf])
def test_what_is_not_finite_is_refused(number):
    with pytest.raises(SignalError, match='finite'):
        limited(Twist(0.0, number, 0.0))
    with pytest.raises(SignalError, match='time step'):
        limited(Twist(0.1, 0.0, 0.0), number)
    with pytest.raises(ConfigurationError, match='turn_rate'):
        ChassisLimitParameters(turn_rate=number)


def test_a_negative_step_and_a_negative_limit_are_refused():
    with pytest.raises(SignalError, match='time step'):
        limited(Twist(0.1, 0.0, 0.0), -1e-9)
    with pytest.raises(ConfigurationError, match='linear_speed = -1'):
        ChassisLimitParameters(linear_speed=-1.0)
