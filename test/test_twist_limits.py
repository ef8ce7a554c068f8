"""Limits of a twist: all of it is slowed by one factor, so that its direction stays."""

from __future__ import annotations

from math import hypot, inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.planar import REST, Twist
from agv_motion.twist_limits import TwistLimits

SPEEDS = st.floats(-1e6, 1e6)
LIMITS = st.builds(TwistLimits, *[st.floats(0.001, 100.0)] * 4)
GIVEN = TwistLimits(track=0.4, wheel_speed=1.0, linear_speed=0.8, turn_rate=2.0)


@pytest.mark.parametrize(
    ('twist', 'held'),
    [
        (Twist(0.5, 0.0, 1.0), Twist(0.5, 0.0, 1.0)),  # 0.5 + 1.0 * 0.2 m/s at the outer wheel
        (Twist(-1.6, 0.0, 0.5), Twist(-0.8, 0.0, 0.25)),  # along: half of it
        (Twist(0.0, 0.1, -8.0), Twist(0.0, 0.025, -2.0)),  # turn: a quarter
        (Twist(0.6, 0.0, 2.0), Twist(0.6, 0.0, 2.0)),  # all of the wheel
        (Twist(0.6, 0.8, 5.0), Twist(0.24, 0.32, 2.0)),  # 2.5 times the turn, 2 times the wheel
        (Twist(0.75, 0.0, 2.5), Twist(0.6, 0.0, 2.0)),  # 1.25 m/s at the wheel
        (REST, REST),
    ],
)
def test_worked_cases(twist, held):
    assert GIVEN.hold(twist) == pytest.approx(held)


@given(LIMITS, st.builds(Twist, SPEEDS, SPEEDS, SPEEDS))
def test_no_limit_is_passed_the_direction_stays_and_what_is_allowed_is_left_alone(limits, twist):
    held = limits.hold(twist)
    linear, turn = hypot(held.vx, held.vy), abs(held.wz)
    least = 1.0 + 1e-9
    assert linear <= least * limits.linear_speed
    assert turn <= least * limits.turn_rate
    assert linear + 0.5 * limits.track * turn <= least * limits.wheel_speed
    size, was = hypot(*held), hypot(*twist)
    assert size <= was
    assert [was * part for part in held] == pytest.approx(
        [size * part for part in twist], rel=1e-9, abs=1e-9 * size * was
    )
    assert limits.hold(held) == pytest.approx(held)


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_no_number_is_refused(bad):
    with pytest.raises(SignalError, match='twist must be finite'):
        GIVEN.hold(Twist(0.0, bad, 0.0))
    with pytest.raises(ConfigurationError, match='wheel_speed'):
        TwistLimits(wheel_speed=bad)
