"""The one rule of all odometries, over readings in any disorder, and where it decides by hand."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.continuity import Continuity, Succession


def order(speed=1.0, max_gap=0.5):
    """Return the order of a thing on a line that goes no faster than ``speed`` [m/s]."""
    return Continuity[float](max_gap, lambda a, b, seconds: abs(b - a) <= speed * seconds + 1e-9)


def steps(readings, **options):
    judge = order(**options).judge
    return [judge(*reading) for reading in readings]


@given(st.lists(st.tuples(st.floats(-1e9, 1e9), st.floats(-1e9, 1e9)), max_size=40))
def test_between_leaps_time_never_runs_back(readings):
    found, last = order(), -inf
    assert found.stamp == last
    for stamp, value in readings:
        step = found.judge(stamp, value)
        if step in {Succession.MOVED, Succession.GAP}:
            assert stamp > last
        if step.used:
            last = stamp
        assert found.stamp == last
        assert found.unseen >= 0.0


@given(st.permutations(range(12)))
def test_of_a_shuffled_second_the_newest_count(places):
    """Whatever the order: what counts is newer than all before, and nothing counts twice."""
    found, newest = order(speed=1e9, max_gap=2.0), -inf
    for place in places:
        step = found.judge(0.1 * place, 0.0)
        assert step.used == (place > newest)
        newest = max(newest, place)


def test_a_leap_is_believed_once_the_next_goes_on_from_it():
    readings = [(0.0, 0.0), (0.1, 0.0), (1e9, 0.0), (0.2, 0.0), (1e9, 0.0), (1e9 + 1, 0.0)]
    expected = [
        Succession.FIRST,
        Succession.MOVED,
        Succession.DOUBTED,
        Succession.MOVED,
        Succession.DOUBTED,
        Succession.LEAP,
    ]
    assert steps(readings) == expected


def test_a_jump_is_believed_once_the_next_goes_on_from_it():
    readings = [(0.0, 0.0), (0.1, 9.0), (0.2, 0.1), (0.3, 9.0), (0.4, 9.1), (0.5, 9.2)]
    expected = [
        Succession.FIRST,
        Succession.DOUBTED,
        Succession.MOVED,
        Succession.DOUBTED,
        Succession.RESET,
        Succession.MOVED,
    ]
    assert steps(readings) == expected


def test_a_clock_and_a_value_that_leap_together_are_a_reset():
    readings = [(0.0, 0.0), (-99.0, 500.0), (-98.9, 500.0)]
    assert steps(readings) == [Succession.FIRST, Succession.DOUBTED, Succession.RESET]


def test_late_readings_in_a_row_are_late_until_they_span_a_gap():
    late = [(-1.0 + 0.2 * i, 0.0) for i in range(5)]
    expected = [
        Succession.FIRST,
        Succession.LATE,
        Succession.LATE,
        Succession.LATE,
        Succession.LEAP,
        Succession.MOVED,
    ]
    assert steps([(0.0, 0.0), *late]) == expected


def test_what_late_readings_may_have_hidden_is_unseen():
    """A clock set back by 0.3 s: until it has caught up, so long may be lost."""
    found = order()
    for stamp, unseen in ((0.0, 0.0), (-0.3, 0.0), (-0.1, 0.0), (0.1, 0.3), (0.2, 0.0)):
        found.judge(stamp, 0.0)
        assert found.unseen == pytest.approx(unseen)


@pytest.mark.parametrize('stamp', [nan, inf, -inf])
def test_a_stamp_that_is_not_finite_is_refused_and_nothing_has_changed(stamp):
    found = order()
    for _ in range(2):
        with pytest.raises(SignalError, match='stamp must be finite'):
            found.judge(stamp, 0.0)
        assert found.judge(1.0, 0.0) in {Succession.FIRST, Succession.DUPLICATE}
