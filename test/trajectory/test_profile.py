"""Pieces of constant acceleration, and their mean over a while, against sums."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.trajectory.profile import RoundedProfile, SharpProfile

ROUNDING = 0.5
times = st.floats(-0.5, 12.0)


def sharp():
    """Up to 2 m/s within 2 s, 3 s on, down within 1 s: 2 + 6 + 1 m."""
    return SharpProfile([0.0, 2.0, 5.0, 6.0], [0.0, 2.0, 8.0, 9.0], [0.0, 2.0, 2.0, 0.0],
                        [1.0, 0.0, -2.0, 0.0])  # fmt: skip


def test_sharp_by_hand():
    profile = sharp()
    assert (profile.duration, profile.top_speed) == (6.0, 2.0)
    assert profile.at(1.0) == (0.5, 1.0, 1.0)
    assert profile.at(3.0) == (4.0, 2.0, 0.0)
    assert profile.at(5.5) == (8.75, 1.0, -2.0)
    assert profile.at(7.0) == (9.0, 0.0, 0.0)


def test_before_its_start_it_came_on_at_constant_speed():
    profile = SharpProfile([0.0, 1.0], [0.5, 1.0], [1.0, 0.0], [-1.0, 0.0])
    assert profile.at(-0.25) == (0.25, 1.0, 0.0)
    assert profile.way(-0.25) == 0.25
    assert profile.moment(-0.25, profile.integrals()) == pytest.approx((-0.09375, 0.25, 1.0))
    assert profile.area(-0.25, profile.integrals()) == pytest.approx(-0.09375)


@given(times)
def test_the_way_alone_is_that_of_the_progress(time):
    for profile in (sharp(), RoundedProfile(sharp(), ROUNDING)):
        assert profile.way(time) == pytest.approx(profile.at(time).way, abs=1e-12)


@settings(max_examples=30)
@given(st.floats(0.0, 8.0))
def test_the_integral_is_the_sum(time):
    profile = sharp()
    grid = (np.arange(500) + 0.5) / 500 * time
    summed = sum(profile.way(t) for t in grid) / 500 * time
    assert profile.area(time, profile.integrals()) == pytest.approx(summed, abs=1e-4)
    whole, way, speed = profile.moment(time, profile.integrals())
    assert whole == profile.area(time, profile.integrals())
    assert (way, speed) == pytest.approx(profile.at(time)[:2])


def test_rounded_it_takes_as_much_longer_and_its_acceleration_grows_steadily():
    """The mean acceleration of the last half second."""
    profile = RoundedProfile(sharp(), ROUNDING)
    assert (profile.duration, profile.top_speed) == (6.5, 2.0)
    assert profile.at(0.25).acceleration == pytest.approx(0.5)
    assert profile.at(0.5) == pytest.approx((0.5**3 / 6 / 0.5, 0.25, 1.0))
    assert profile.at(5.25).acceleration == pytest.approx(-1.0)
    assert profile.at(6.5) == pytest.approx((9.0, 0.0, 0.0))
    assert profile.at(99.0) == (9.0, 0.0, 0.0)


@given(st.floats(0.05, 6.4))
def test_speed_and_acceleration_are_derivatives(time):
    h = 1e-5
    profile = RoundedProfile(sharp(), ROUNDING)
    before, now, after = (profile.at(time + shift) for shift in (-h, 0.0, h))
    assert now.speed == pytest.approx((after.way - before.way) / (2 * h), abs=1e-6)
    assert now.acceleration == pytest.approx((after.speed - before.speed) / (2 * h), abs=1e-4)


@pytest.mark.parametrize('rounding', [0.0, ROUNDING])
def test_stopped_it_is_the_same_until_then(rounding):
    """From 2 m/s at 4 m with 4 m/s2: half a second and half a metre more."""
    profile = RoundedProfile(sharp(), rounding) if rounding else sharp()
    stopped = profile.stopped(3.0, 4.0)
    assert stopped.at(2.9) == profile.at(2.9)
    assert stopped.duration == pytest.approx(3.5 + rounding)
    assert stopped.at(99.0) == pytest.approx((4.5, 0.0, 0.0))
    assert sharp().stopped(6.0, 4.0).duration == 6.0


def test_pieces_by_the_squares_of_their_speeds():
    """A metre from rest to 2 m/s, two on, one back to rest; it came with 1 m/s, which jumps."""
    one = np.array
    profile = SharpProfile.of_pieces(
        one([0.0, 1.0, 3.0]), one([1.0, 2.0, 1.0]), one([0.0, 4.0, 4.0]), one([4.0, 4.0, 0.0]),
        one([2.0, 0.0, -2.0]), start_speed=1.0, end=4.0,
    )  # fmt: skip
    assert profile.duration == pytest.approx(3.0)
    assert profile.at(-0.1).speed == 1.0
    assert profile.at(0.5) == pytest.approx((0.25, 1.0, 2.0))
    assert profile.at(1.5) == pytest.approx((2.0, 2.0, 0.0))
    assert profile.at(3.0) == pytest.approx((4.0, 0.0, 0.0))
