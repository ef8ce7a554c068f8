"""A number that follows another: never too fast, never too jerky, there at last, any step."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.motion.command.ramp import Ramp

SHARE = st.floats(-1.0, 1.0)
RATE = st.one_of(st.just(inf), st.floats(0.01, 10.0))
JERK = st.one_of(st.just(inf), st.floats(0.01, 100.0))
STEPS = st.lists(st.tuples(SHARE, st.floats(0.0, 3.0)), min_size=1, max_size=30)


def test_a_ramp_by_hand():
    """0 to 1 at 0.5/s: 0.25 after half a second, there after two."""
    ramp = Ramp(0.5)
    assert [ramp.advance(1.0, 0.5) for _ in range(5)] == [0.25, 0.5, 0.75, 1.0, 1.0]


def test_a_jerky_move_by_hand():
    """0 to 1 with rate 0.5 and jerk 1: 0.5 s up, 1.5 s held, 0.5 s down: 2.5 s."""
    ramp = Ramp(0.5, 1.0)
    assert ramp.advance(1.0, 0.5) == pytest.approx(0.125)
    assert ramp.slope == pytest.approx(0.5)
    assert ramp.advance(1.0, 1.5) == pytest.approx(0.875)
    assert ramp.advance(1.0, 0.25) == pytest.approx(1.0 - 0.5 * 0.25**2)
    assert ramp.advance(1.0, 0.26) == 1.0
    assert ramp.slope == 0.0


def test_a_short_move_never_reaches_the_rate():
    """0 to 0.16 with jerk 1: a peak slope of 0.4 after 0.4 s."""
    ramp = Ramp(0.5, 1.0)
    assert ramp.advance(0.16, 0.4) == pytest.approx(0.08)
    assert ramp.slope == pytest.approx(0.4)
    assert ramp.advance(0.16, 0.41) == 0.16


@given(RATE, JERK, STEPS)
def test_no_rate_is_ever_exceeded_and_no_bound_overshot(rate, jerk, steps):
    ramp, lowest, highest = Ramp(rate, jerk), 0.0, 0.0
    for target, dt in steps:
        before, slope = ramp.value, ramp.slope
        lowest, highest = min(lowest, target), max(highest, target)
        value = ramp.advance(target, dt)
        assert lowest - 1e-9 <= value <= highest + 1e-9
        if rate < inf:
            assert abs(value - before) <= rate * dt + 1e-9
            if jerk < inf and value != target:
                assert abs(ramp.slope - slope) <= jerk * dt + 1e-9
                assert abs(ramp.slope) <= rate + 1e-9


@given(RATE, JERK, STEPS, SHARE)
def test_the_target_is_reached_and_kept(rate, jerk, steps, target):
    ramp = Ramp(rate, jerk)
    for wanted, dt in steps:
        ramp.advance(wanted, dt)
    for _ in range(500):
        if ramp.advance(target, 10.0) == target and ramp.slope == 0.0:
            break
    assert ramp.advance(target, 0.0) == target == ramp.advance(target, 1.0)


@given(RATE, JERK, STEPS, st.tuples(SHARE, st.floats(0.0, 5.0)), st.floats(0.0, 1.0))
def test_two_parts_of_a_step_are_the_whole(rate, jerk, steps, last, share):
    target, dt = last
    once, twice = Ramp(rate, jerk), Ramp(rate, jerk)
    for wanted, step in steps:
        once.advance(wanted, step)
        twice.advance(wanted, step)
    once.advance(target, dt)
    twice.advance(target, share * dt)
    assert twice.advance(target, (1.0 - share) * dt) == pytest.approx(once.value, abs=1e-6)


@pytest.mark.parametrize('dt', [-0.1, nan, inf])
def test_a_time_step_that_is_none_is_refused(dt):
    with pytest.raises(SignalError, match='time step'):
        Ramp(1.0).advance(1.0, dt)
