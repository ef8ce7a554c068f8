"""Encoders: what they say is taken for what it is worth, and nothing rolled is counted twice."""

from __future__ import annotations

from math import inf, nan, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.encoders import Encoders
from agv_motion.odometry.parameters import OdometryParameters

RADII = [0.1, 0.2]
TURN = st.floats(-1.0, 1.0)


def started(**parameters):
    encoders = Encoders(RADII, OdometryParameters(**parameters))
    assert encoders.read(10.0, [1.0, 2.0]) is Succession.FIRST
    return encoders


def test_angles_times_radii_are_travels():
    encoders = started()
    assert encoders.read(10.1, [1.5, 1.0]) is Succession.MOVED
    assert encoders.travel == pytest.approx([0.05, -0.2], abs=1e-15)
    assert encoders.rolled == pytest.approx(0.25, abs=1e-15)
    assert encoders.duration == pytest.approx(0.1, abs=1e-14)


def test_the_first_reading_tells_nothing():
    encoders = Encoders(RADII, OdometryParameters())
    assert encoders.stamp is None
    assert encoders.read(10.0, [1.0, 2.0]) is Succession.FIRST
    assert (encoders.stamp, list(encoders.travel), encoders.rolled) == (10.0, [], 0.0)
    assert (encoders.duration, encoders.doubt) == (0.0, 0.0)


@pytest.mark.parametrize(('stamp', 'step'), [(10.0, Succession.DUPLICATE), (9.9, Succession.LATE)])
def test_a_stamp_that_is_not_new_changes_nothing(stamp, step):
    encoders = started()
    assert encoders.read(stamp, [5.0, 5.0]) is step
    assert encoders.stamp == 10.0
    assert encoders.read(10.1, [1.1, 2.0]) is Succession.MOVED
    assert encoders.travel == pytest.approx([0.01, 0.0], abs=1e-15)


@given(st.lists(st.tuples(TURN, TURN), min_size=1, max_size=30))
def test_encoders_that_go_round_lose_nothing(turns):
    encoders, angles, rolled = started(encoder_range=tau), [1.0, 2.0], [0.0, 0.0]
    for i, turn in enumerate(turns):
        angles = [a + t for a, t in zip(angles, turn, strict=True)]
        step = encoders.read(10.1 + 0.1 * i, [angle % tau for angle in angles])
        assert step is Succession.MOVED
        rolled = [a + b for a, b in zip(rolled, encoders.travel, strict=True)]
    expected = [(a - b) * r for a, b, r in zip(angles, [1.0, 2.0], RADII, strict=True)]
    assert rolled == pytest.approx(expected, abs=1e-12)


def test_encoders_that_start_again_are_noticed():
    """Rolling 0.15 m/s before, over 0.1 s, each wheel may have gone 15 mm meanwhile."""
    encoders = started(max_wheel_speed=1.0)
    encoders.read(10.1, [1.1, 2.1])
    assert encoders.read(10.2, [0.0, 0.0]) is Succession.DOUBTED
    assert encoders.stamp == 10.1
    assert encoders.read(10.3, [0.1, 0.0]) is Succession.RESET
    assert encoders.travel == pytest.approx([0.01, 0.0], abs=1e-15)
    assert encoders.duration == pytest.approx(0.1)
    assert encoders.doubt == pytest.approx(0.015, abs=1e-9)
    assert encoders.read(10.4, [0.2, 0.0]) is Succession.MOVED
    assert encoders.travel == pytest.approx([0.01, 0.0], abs=1e-15)
    assert encoders.doubt == 0.0


def test_one_impossible_reading_costs_nothing():
    encoders = started()
    assert encoders.read(10.1, [900.0, 2.0]) is Succession.DOUBTED
    assert encoders.read(10.2, [1.2, 2.0]) is Succession.MOVED
    assert encoders.travel == pytest.approx([0.02, 0.0], abs=1e-15)
    assert encoders.doubt == 0.0


def test_a_gap_keeps_the_travel_and_says_so():
    encoders = started(max_gap=0.5)
    assert encoders.read(20.0, [2.0, 2.0]) is Succession.GAP
    assert encoders.travel == pytest.approx([0.1, 0.0], abs=1e-15)


def test_a_gap_in_which_the_encoders_may_have_gone_round_loses_the_travel():
    encoders = started(max_gap=0.5, encoder_range=tau, max_wheel_speed=0.1)
    assert encoders.read(12.0, [2.0, 2.0]) is Succession.GAP
    assert encoders.read(20.0, [3.0, 2.0]) is Succession.RESET


@pytest.mark.parametrize('stamp', [-500.0, 7200.0, 2.1e9])
def test_a_clock_that_leaps_loses_no_travel_and_costs_certainty(stamp):
    """Two positions tell of 0.03 m and 0.04 m, of which 0.02 m and 0.02 m took 0.1 s.

    The pose is as unsure as the rest, no more.
    """
    encoders = started()
    assert encoders.read(stamp, [1.1, 2.1]) is Succession.DOUBTED
    assert encoders.read(stamp + 0.1, [1.3, 2.2]) is Succession.LEAP
    assert encoders.beyond == pytest.approx([0.01, 0.02], abs=1e-15)
    assert encoders.travel == pytest.approx([0.02, 0.02], abs=1e-15)
    assert encoders.duration == pytest.approx(0.1, abs=1e-6)
    assert encoders.doubt == pytest.approx(0.015, abs=1e-12)
    assert encoders.read(stamp + 0.2, [1.4, 2.2]) is Succession.MOVED


def test_a_clock_set_back_a_little_loses_no_travel():
    """5 s back: what comes is late, until it has gone on for longer than a gap."""
    encoders, rolled = started(max_gap=0.5), 0.0
    for i in range(1, 101):
        step = encoders.read(5.0 + 0.1 * i, [1.0 + 0.05 * i, 2.0])
        if step.used:
            rolled += encoders.travel[0] + (encoders.beyond[0] if step is Succession.LEAP else 0.0)
        assert step is (
            Succession.LATE if i <= 6 else Succession.LEAP if i == 7 else Succession.MOVED
        )
    assert rolled == pytest.approx(100 * 0.05 * 0.1, abs=1e-12)


@pytest.mark.parametrize('angles', [[nan, 0.0], [0.0, inf], [-inf, inf]])
def test_angles_that_are_not_finite_change_nothing(angles):
    encoders = started()
    with pytest.raises(SignalError, match='wheel angles must be finite'):
        encoders.read(10.1, angles)
    assert encoders.stamp == 10.0
    assert encoders.read(10.1, [1.1, 2.0]) is Succession.MOVED


@pytest.mark.parametrize('count', [0, 1, 3])
@pytest.mark.parametrize('stamp', [10.1, 20.0])
def test_a_wrong_number_of_angles_changes_nothing(stamp, count):
    encoders = started()
    with pytest.raises(SignalError, match=f'{count} wheel angles for 2 wheels'):
        encoders.read(stamp, [1.0] * count)
    assert encoders.stamp == 10.0


@pytest.mark.parametrize('stamp', [nan, inf])
def test_a_stamp_that_is_not_finite_is_refused(stamp):
    with pytest.raises(SignalError, match='stamp must be finite'):
        started().read(stamp, [1.0, 2.0])


@pytest.mark.parametrize('radius', [0.0, -0.1, nan, inf])
def test_an_impossible_radius_is_refused(radius):
    with pytest.raises(ConfigurationError, match='above 0'):
        Encoders([0.1, radius], OdometryParameters())


@pytest.mark.parametrize('durations', [(0.1, 0.2), (0.2, 0.1)])
def test_rates_that_stay_the_same_leave_no_doubt_however_long_a_step(durations):
    """1 rad/s and -2 rad/s; then twice as fast: each wheel may be wrong by what it gained."""
    encoders, (first, second) = started(), durations
    encoders.read(10.0 + first, [1.0 + first, 2.0 - 2.0 * first], by_rate=True)
    now, angles = 10.0 + first + second, [1.0 + first + second, 2.0 - 2.0 * (first + second)]
    encoders.read(now, angles, by_rate=True)
    assert encoders.doubt == pytest.approx(0.0, abs=1e-12)
    encoders.read(now + first, [angles[0] + 2.0 * first, angles[1] - 4.0 * first], by_rate=True)
    assert encoders.doubt == pytest.approx(2.0 * first * RADII[1], abs=1e-12)
