"""The time a tree lives through, whatever its clock does."""

from __future__ import annotations

import pytest

from agv_motion.motion.navigation.reservations.lived_time import LivedTime


def test_it_goes_with_the_clock_never_back_and_takes_no_leap_for_time():
    time = LivedTime(1.0)
    shown = [1000.0, 1000.5, 1000.5, 900.0, 900.5, 1e9, 1e9 + 0.5]
    assert [time.update(clock) for clock in shown] == [0.0, 0.5, 0.5, 0.5, 1.0, 2.0, 2.5]


def test_a_clock_that_stands_does_not_hold_up_the_steady_one_and_a_fast_one_goes_first():
    time = LivedTime(1.0)
    shown = [(0.0, 50.0), (0.5, 50.0), (1.0, 50.0), (1.1, 50.8), (1.2, 0.0)]
    lived = [time.update(*clocks) for clocks in shown]
    assert lived == pytest.approx([0.0, 0.5, 1.0, 1.8, 1.9])
