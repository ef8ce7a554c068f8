"""Angles from positions, rates, or now the one, now the other: no travel lost, none twice."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.wheel_angles import WheelAngles


def angles(count=2):
    return WheelAngles(count, max_gap=1.0, max_rate=100.0)


def test_rates_are_added_up_by_the_trapezoidal_rule():
    """Hand calculation: from 1 to 3 rad/s within 0.5 s is 1 rad; a silent wheel stands still."""
    found = angles()
    assert found.add(1.0, [], [1.0, 1.0]) == [0.0, 0.0]
    assert found.add(1.5, [], [3.0, None]) == [1.0, None]
    assert found.add(1.4, [], [9.0, 9.0]) == [1.0, 0.0]  # late: adds nothing
    assert found.add(2.0, [], [3.0, 1.0])[1] == 0.0
    assert found.add(3.0, [], [3.0, 1.0])[1] == pytest.approx(1.0)
    assert found.by_rate


def test_positions_are_the_angles():
    found = angles()
    assert found.add(0.0, [3.0, 4.0], [9.0, 9.0]) == [3.0, 4.0]
    assert found.add(0.1, [3.5, 4.5], []) == [3.5, 4.5]
    assert not found.by_rate


@given(st.lists(st.sampled_from(['both', 'positions', 'rates']), min_size=1, max_size=30))
def test_fields_that_come_and_go_lose_no_turn(fields):
    """A wheel at 2 rad/s whose encoder stands at 50 rad at first: whatever field is of use."""
    found, told = angles(1), []
    for i, field in enumerate(['both', *fields]):
        position = None if field == 'rates' else 50.0 + 0.2 * i
        told += found.add(0.1 * i, [position], [None if field == 'positions' else 2.0])
    assert told == pytest.approx([50.0 + 0.2 * i for i in range(len(told))], abs=1e-9)


@given(st.lists(st.sampled_from(['positions', 'rates']), min_size=1, max_size=30))
def test_where_rates_come_first_positions_go_on_from_them(fields):
    found, told = angles(1), []
    for i, field in enumerate(['rates', *fields]):
        position, rate = (None, 2.0) if field == 'rates' else (50.0 + 0.2 * i, None)
        told += found.add(0.1 * i, [position], [rate])
    assert told == pytest.approx([0.2 * i for i in range(len(told))], abs=1e-9)


def test_a_leap_of_the_clock_turns_nothing():
    found = angles(1)
    for stamp, expected in ((0.0, 0.0), (0.1, 0.2), (3600.0, 0.2), (3600.1, 0.4), (3600.2, 0.6)):
        assert found.add(stamp, [], [2.0])[0] == pytest.approx(expected, abs=1e-6)


def test_a_rate_that_cannot_be_is_refused_and_nothing_has_changed():
    found = angles(1)
    found.add(0.0, [], [2.0])
    with pytest.raises(SignalError, match='wheel rates = 1e\\+30 rad/s: cannot be beyond 100'):
        found.add(0.1, [], [1e30])
    assert found.add(0.2, [], [2.0])[0] == pytest.approx(0.4)
    assert found.add(0.3, [0.7], [1e30])[0] == pytest.approx(0.6)
    assert found.add(0.4, [], [2.0])[0] == pytest.approx(0.8)
