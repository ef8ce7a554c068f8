"""Mean wheel speeds along an arc end exactly at its end, whatever the cycles."""

from __future__ import annotations

from math import inf, nan, pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.trajectory.arc import Arc
from agv_motion.trajectory.arc_run import ArcRun

TRACK = 0.3
QUARTER = Arc(pi / 2, 0.7, TRACK, 0.4, 0.3)
"""To the left: the inner wheel on a radius of 0.35 m, the outer of 0.65 m."""


@settings(max_examples=40)
@given(st.lists(st.floats(0.001, 0.7), min_size=1, max_size=40), st.sampled_from([0.0, 0.2]))
def test_the_wheels_end_where_the_arc_ends(periods, rounding):
    run = ArcRun(QUARTER, rounding)
    left = right = 0.0
    for dt in [*periods, *([0.5] * 12)]:
        speeds = run.advance(dt)
        left, right = left + speeds.left * dt, right + speeds.right * dt
        assert 0.0 <= speeds.left <= speeds.right <= 0.4 + 1e-9
    assert run.finished
    assert (left, right) == pytest.approx((0.35 * pi / 2, 0.65 * pi / 2))
    assert run.travel == pytest.approx((left, right))


def test_how_long_it_takes_by_hand():
    """A trapezoid of the outer wheel: s / v + v / a."""
    run = ArcRun(QUARTER)
    assert run.duration == pytest.approx(0.65 * pi / 2 / 0.4 + 0.4 / 0.3)
    assert ArcRun(QUARTER, 0.2).duration == pytest.approx(run.duration + 0.2)
    assert run.advance(1.0).right == pytest.approx(0.15)  # 0.3 m/s2 over 1 s, on the mean
    assert not run.finished


def test_backwards_and_to_the_right_the_left_wheel_is_the_outer_one():
    run = ArcRun(Arc(-pi / 2, 0.7, TRACK, -0.4, 0.3))
    speeds = run.advance(1.0)
    assert speeds.left == pytest.approx(-0.15)
    assert speeds.right == pytest.approx(-0.15 * 0.35 / 0.65)


def test_no_arc_is_done_at_once():
    run = ArcRun(Arc(0.0, 0.7, TRACK, 0.4, 0.3))
    assert (run.finished, run.duration) == (True, 0.0)
    assert run.advance(0.1) == (0.0, 0.0)


@pytest.mark.parametrize('dt', [0.0, -0.1, inf, nan])
def test_a_cycle_takes_time(dt):
    with pytest.raises(SignalError, match='give a finite time above 0'):
        ArcRun(QUARTER).advance(dt)
