"""Wheels that roll: their angles grow without end, and stay exact over months."""

from __future__ import annotations

from math import inf, nan, pi, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.model.rolling import CountedWheels, WheelTurns

SECOND = 1_000_000_000
MONTHS = 7 * 30 * 86400.0
"""[s]"""


@given(st.lists(st.floats(-100.0, 100.0), max_size=30))
def test_angles_add_up(angles):
    wheel = WheelTurns(1)
    for angle in angles:
        wheel.add([angle])
    assert wheel.angles()[0] == pytest.approx(sum(angles), abs=1e-9)


def test_after_seven_months_a_small_step_still_counts_whole():
    wheel = WheelTurns(2)
    before = 0.333 * MONTHS  # the top speed of the tree, day and night
    wheel.add([before, -before])
    start = wheel.angles()
    for _ in range(1000):
        wheel.add([1e-9, -1e-9])  # less than the spacing of numbers of this size
    forward, backward = wheel.angles()
    assert forward - start[0] == pytest.approx(1e-6, abs=2e-9)
    assert forward == -backward > 1e6 * tau / tau


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_no_angle_turns_nothing(bad):
    wheel = WheelTurns(2)
    wheel.add([bad, 1.0])
    assert wheel.angles() == [0.0, 1.0]


def test_rates_are_added_up_where_the_drives_count_no_turns():
    wheels = CountedWheels(2)
    for i in range(11):
        told = wheels.update(i * SECOND // 10, [0.0, 0.0], [1.0, -0.2 * i])
    assert told == pytest.approx([1.0, -1.0])  # 1 rad/s for 1 s; from 0 to -2 rad/s evenly


def test_angles_that_are_told_are_passed_on():
    wheels = CountedWheels(1)
    assert wheels.update(0, [0.0], [0.0]) == [0.0]
    assert wheels.update(SECOND, [7.0], [1.0]) == [7.0]
    assert wheels.update(2 * SECOND, [nan], [1.0]) == [7.0]
    assert wheels.update(3 * SECOND, [0.0], [1.0]) == [0.0]  # through 0 it counts on
    assert wheels.update(4 * SECOND, [], []) == [0.0]


def test_a_silence_and_a_clock_that_goes_back_count_as_rest():
    wheels = CountedWheels(1)
    for seconds in (0.0, 0.5, 2.0, 1.0, 1.5):
        told = wheels.update(round(seconds * SECOND), [], [2 * pi])
    assert told == pytest.approx([2 * pi])
    assert wheels.update(2 * SECOND, [], []) == pytest.approx([2 * pi])
