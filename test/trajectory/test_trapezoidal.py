"""A trapezoid in one call: distance, top speed and both ramps hold; triangles where it is short."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory import NO_RAMP, trapezoid
from agv_motion.trajectory.speed_plan import plan_speed

some = st.floats(0.05, 20.0)


def test_by_hand():
    """Up to 2 m/s in 2 s over 2 m, down in 1 s over 1 m, the other 7 m in 3.5 s."""
    profile = trapezoid(10.0, 2.0, 1.0, 2.0)
    assert profile.duration == pytest.approx(6.5)
    assert profile.at(1.0) == pytest.approx((0.5, 1.0, 1.0))
    assert profile.at(3.0) == pytest.approx((4.0, 2.0, 0.0))
    assert profile.at(6.0) == pytest.approx((9.75, 1.0, -2.0))
    assert profile.at(7.0) == pytest.approx((10.0, 0.0, 0.0))


def test_a_short_one_is_a_triangle():
    """Ramps of 1 and 3 m/s2 over 6 m meet at 3 m/s: 4.5 m up and 1.5 m down, in 3 s and 1 s."""
    profile = trapezoid(6.0, 100.0, 1.0, 3.0)
    assert profile.top_speed == pytest.approx(3.0)
    assert profile.duration == pytest.approx(4.0)


@given(some, some, some, some, st.sampled_from([0.0, 0.3]))
def test_distance_and_limits_hold(distance, speed, up, down, rounding):
    profile = trapezoid(distance, speed, up, down, rounding)
    seen = [profile.at(t) for t in np.linspace(0.0, profile.duration, 200)]
    assert profile.at(profile.duration).way == pytest.approx(distance, rel=1e-9)
    assert seen[0].way == pytest.approx(0.0, abs=1e-9)
    for _, now, acceleration in seen:
        assert -1e-9 <= now <= speed * (1 + 1e-9)
        assert -down * (1 + 1e-9) - 1e-9 <= acceleration <= up * (1 + 1e-9) + 1e-9
    assert min(profile.at(profile.duration).speed, 1.0) == pytest.approx(0.0, abs=1e-6)


@given(some, some, some)
def test_with_equal_ramps_it_is_the_fastest_there_is(distance, speed, ramp):
    fastest = plan_speed(np.array([0.0, distance]), np.array([speed, speed]), ramp)
    assert trapezoid(distance, speed, ramp).duration == pytest.approx(fastest.duration, rel=1e-12)


def test_no_ramp_is_at_once():
    profile = trapezoid(3.0, 1.5, NO_RAMP, NO_RAMP)
    assert profile.duration == pytest.approx(2.0)
    assert profile.at(1e-9).speed == pytest.approx(1.5)
    half = trapezoid(3.0, 1.5, NO_RAMP, 1.5)
    assert half.duration == pytest.approx(1.5 + 1.0)


def test_no_distance_is_done_at_once():
    profile = trapezoid(0.0, 1.0, 1.0)
    assert profile.duration == 0.0
    assert profile.at(5.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ((-1.0, 1.0, 1.0), 'distance'),
        ((nan, 1.0, 1.0), 'distance'),
        ((1.0, 0.0, 1.0), 'speed'),
        ((1.0, 1.0, -1.0), 'acceleration'),
        ((1.0, 1.0, 1.0, inf), 'braking'),
        ((1.0, 1.0, 1.0, 1.0, -0.1), 'rounding'),
    ],
)
def test_what_is_no_number_for_it_is_refused_by_name(given, words):
    with pytest.raises(ConfigurationError, match=words):
        trapezoid(*given)
