"""Time of the bag against time on the wall."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag.playback.delay_histogram import DelayHistogram
from agv_motion.bag.playback.timeline import Timeline

SECOND = 1_000_000_000


def test_it_stands_until_resumed_and_goes_at_its_rate():
    timeline = Timeline(100 * SECOND, 2.0)
    assert timeline.position(5.0) == 100 * SECOND
    timeline.resume(5.0)
    assert timeline.position(6.0) == 102 * SECOND
    assert timeline.due(103 * SECOND) == 6.5


def test_a_pause_does_not_count():
    timeline = Timeline(0, 1.0)
    timeline.resume(0.0)
    timeline.pause(3.0)
    assert timeline.position(10.0) == 3 * SECOND
    timeline.resume(10.0)
    assert timeline.position(11.0) == 4 * SECOND


def test_another_rate_holds_from_where_it_is():
    timeline = Timeline(0, 1.0)
    timeline.resume(0.0)
    timeline.set_rate(10.0, 2.0)
    assert timeline.position(2.0) == 2 * SECOND
    assert timeline.position(3.0) == 12 * SECOND


def test_a_jump_keeps_standing_or_going():
    timeline = Timeline(0, 1.0)
    timeline.jump(50 * SECOND, 1.0)
    assert timeline.position(9.0) == 50 * SECOND
    timeline.resume(9.0)
    timeline.jump(7 * SECOND, 10.0)
    assert timeline.position(11.0) == 8 * SECOND


@given(st.floats(0.01, 100.0), st.integers(0, 10**15), st.integers(0, 10**13))
def test_due_and_position_are_inverse(rate, start, later):
    timeline = Timeline(start, rate)
    timeline.resume(123.0)
    position = timeline.position(timeline.due(start + later))
    assert position - (start + later) == pytest.approx(0.0, abs=1e3 + later * 1e-9)


def test_lag_by_hand():
    lag = DelayHistogram()
    for delay in [0.0] * 98 + [0.0015, 0.5]:
        lag.add(delay)
    assert lag.quantile(0.5) == pytest.approx(1e-5)
    assert lag.quantile(0.99) == pytest.approx(1.51e-3)
    assert (lag.worst, lag.quantile(1.0)) == (0.5, 0.5)
    assert lag.share_within(0.002) == 0.99
    assert '99.0% within 2 ms' in str(lag)
