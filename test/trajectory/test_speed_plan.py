"""The fastest speed: closed forms, limits, optimality, rounding."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError
from agv_motion.trajectory import speed_plan
from agv_motion.trajectory.bounds import AT_ONCE
from agv_motion.trajectory.speed_plan import plan_speed

POSITIVE = st.floats(0.05, 5.0)


def plain(length, cruise, ramp, start=0.0, rounding=0.0):
    return plan_speed(np.array([0.0, length]), np.array([cruise] * 2), ramp, start, rounding)


@st.composite
def ways(draw):
    """Return nodes of a way and a wild ceiling over them."""
    steps = draw(st.lists(st.floats(0.01, 0.5), min_size=1, max_size=30))
    way = np.concatenate(([0.0], np.cumsum(steps)))
    size = {'min_size': len(way), 'max_size': len(way)}
    return way, np.array(draw(st.lists(st.floats(0.1, 2.0), **size)))


@given(st.floats(0.1, 2.0), st.floats(0.1, 2.0), st.floats(0.0, 1.0))
def test_a_trapezoid_in_closed_form(cruise, ramp, margin):
    """Way (1 + margin) v^2 / a: up, cruise, down; it takes length / v + v / a."""
    length = (1.0 + margin) * cruise**2 / ramp
    profile = plain(length, cruise, ramp)
    rise = cruise / ramp
    assert profile.duration == pytest.approx(length / cruise + rise, rel=1e-12)
    assert profile.at(rise / 2).way == pytest.approx(ramp * (rise / 2) ** 2 / 2, rel=1e-12)
    assert profile.at(profile.duration / 2).speed == pytest.approx(cruise, rel=1e-12)
    late = profile.at(profile.duration - rise / 3)
    assert late.way == pytest.approx(length - ramp * (rise / 3) ** 2 / 2, abs=1e-9)


@given(st.floats(0.01, 0.99), st.floats(0.1, 2.0))
def test_a_triangle_where_the_way_is_short(share, ramp):
    cruise = 1.0
    length = share * cruise**2 / ramp
    profile = plain(length, cruise, ramp)
    assert profile.duration == pytest.approx(2 * sqrt(length / ramp), rel=1e-12)
    assert profile.top_speed == pytest.approx(sqrt(length * ramp), rel=1e-12)
    assert profile.at(profile.duration / 2).way == pytest.approx(length / 2, rel=1e-12)


def test_a_start_in_motion_by_hand():
    """From 0.5 m/s to 1 m/s with 0.5 m/s2: 1 s and 0.75 m; braking 2 s and 1 m; 1.25 m between."""
    profile = plain(3.0, 1.0, 0.5, start=0.5)
    assert profile.duration == pytest.approx(1.0 + 1.25 + 2.0, abs=1e-12)
    assert profile.at(0.0).speed == 0.5
    assert profile.at(1.0).way == pytest.approx(0.75, abs=1e-12)


def test_faster_than_cruising_is_refused():
    with pytest.raises(GeometryError, match=r'1\.2 m/s is too fast'):
        plain(30.0, 1.0, 0.5, start=1.2)


def test_faster_than_the_first_bend_allows_is_refused_though_it_could_brake():
    """30 m are enough to brake from 1.2 m/s; but here it may be no faster than 0.8 m/s."""
    way, ceiling = np.array([0.0, 10.0, 30.0]), np.array([0.8, 2.0, 2.0])
    with pytest.raises(GeometryError, match=r'1\.2 m/s is too fast here.* 30 m, allows 0\.8 m/s'):
        plan_speed(way, ceiling, 0.5, 1.2)
    assert plan_speed(way, ceiling, 0.5, 0.8).at(0.0).speed == pytest.approx(0.8)


def test_too_short_to_brake_is_refused():
    with pytest.raises(GeometryError, match=r'0\.9 m, allows 0\.9487 m/s'):
        plain(0.9, 1.0, 0.5, start=1.0)


@given(ways(), st.floats(0.1, 3.0), st.sampled_from([0.0, 0.05, 0.4]))
def test_ceiling_and_acceleration_hold_at_every_moment(way_and_ceiling, ramp, rounding):
    way, ceiling = way_and_ceiling
    profile = plan_speed(way, ceiling, ramp, 0.0, rounding)
    for time in np.linspace(0.0, profile.duration, 300):
        now = profile.at(float(time))
        allowed = np.interp(now.way, way, ceiling**2)
        assert now.speed**2 <= allowed * (1 + 1e-9) + 1e-12
        assert abs(now.acceleration) <= ramp * (1 + 1e-9)
        assert now.speed >= -1e-12


@given(ways(), st.floats(0.1, 3.0))
def test_no_profile_is_faster(way_and_ceiling, ramp):
    """At every node the squared speed is the lowest of the ramps from all nodes."""
    way, ceiling = way_and_ceiling
    bound = ceiling**2
    bound[0] = bound[-1] = 0.0
    best = (bound + 2 * ramp * np.abs(way[:, None] - way)).min(axis=1)
    profile = plan_speed(way, ceiling, ramp)
    times = np.linspace(0.0, profile.duration, 400)
    states = [profile.at(float(time)) for time in times]
    reached = np.array([state.speed**2 for state in states])
    for node, square in zip(way, best, strict=True):
        nearest = int(np.argmin([abs(state.way - node) for state in states]))
        slack = 2.0 * max(ramp, 8.0 / 0.01) * abs(states[nearest].way - node) + 1e-9
        assert reached[nearest] >= square - slack


@given(ways(), st.floats(0.1, 3.0), st.sampled_from([0.0, 0.3]))
def test_way_is_the_integral_of_speed(way_and_ceiling, ramp, rounding):
    profile = plan_speed(*way_and_ceiling, ramp, 0.0, rounding)
    times = np.linspace(0.0, profile.duration, 50)
    h = 1e-6
    for time in map(float, times[1:-1]):
        slope = (profile.at(time + h).way - profile.at(time - h).way) / (2 * h)
        assert profile.at(time).speed == pytest.approx(slope, abs=1e-5)
    assert profile.at(profile.duration).way == pytest.approx(way_and_ceiling[0][-1], rel=1e-12)


@given(st.floats(0.5, 5.0), st.floats(0.1, 2.0), st.floats(0.05, 1.0))
def test_the_s_curve_costs_its_rounding_and_bounds_the_jerk(length, ramp, rounding):
    sharp, rounded = plain(length, 1.0, ramp), plain(length, 1.0, ramp, rounding=rounding)
    assert rounded.duration == pytest.approx(sharp.duration + rounding, rel=1e-12)
    times = np.linspace(0.0, rounded.duration, 500)
    accelerations = [rounded.at(float(time)).acceleration for time in times]
    jerk = np.abs(np.diff(accelerations)) / np.diff(times)
    assert jerk.max() <= 2 * ramp / rounding * (1 + 1e-6)
    assert rounded.at(0.0) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_the_s_curve_in_closed_form():
    """1 m/s, 1 m/s2, rounded over 0.5 s: during the first 0.5 s the jerk is 2 m/s3."""
    profile = plain(5.0, 1.0, 1.0, rounding=0.5)
    assert profile.at(0.3) == pytest.approx((2.0 * 0.3**3 / 6, 2.0 * 0.3**2 / 2, 0.6), abs=1e-12)
    assert profile.duration == pytest.approx(5.0 + 1.0 + 0.5, abs=1e-12)


@given(POSITIVE, st.floats(0.0, 1.0), st.sampled_from([0.0, 0.3]))
def test_the_s_curve_starts_at_the_present_speed(ramp, start, rounding):
    profile = plain(1.0 + start**2 / ramp + start * rounding, 1.0, ramp, start, rounding)
    assert profile.at(0.0).way == pytest.approx(0.0, abs=1e-12)
    assert profile.at(0.0).speed == pytest.approx(start, abs=1e-12)


@given(ways(), st.floats(0.1, 3.0), st.floats(0.0, 1.0), st.sampled_from([0.0, 0.3]))
def test_stopped_it_goes_on_without_a_jump_and_rests(way_and_ceiling, ramp, share, rounding):
    profile = plan_speed(*way_and_ceiling, ramp, 0.0, rounding)
    time = share * profile.duration
    stopped = profile.stopped(time, ramp)
    assert stopped.at(time)[:2] == pytest.approx(profile.at(time)[:2], abs=1e-9)
    assert stopped.at(stopped.duration).speed == 0.0
    assert stopped.at(stopped.duration).way <= way_and_ceiling[0][-1] + 1e-9
    assert stopped.duration <= profile.duration + 1e-9


@given(ways(), st.floats(-3.0, 300.0), st.floats(0.0, 50.0))
def test_a_harder_ramp_never_takes_longer(way_and_ceiling, exponent, more):
    way, ceiling = way_and_ceiling
    gentle = plan_speed(way, ceiling, 10.0**exponent).duration
    hard = plan_speed(way, ceiling, 10.0 ** min(exponent + more, 300.0)).duration
    assert hard <= gentle * (1.0 + 1e-12)


@given(ways(), st.floats(6.0, 300.0), st.sampled_from([0.0, 0.3]))
def test_hard_ramps_take_what_the_ceiling_alone_does(way_and_ceiling, exponent, rounding):
    """The time under a flat ceiling is length / speed, however hard the ramps."""
    way, _ = way_and_ceiling
    for ceiling in (0.1, 2.0):
        profile = plan_speed(way, np.full(len(way), ceiling), 10.0**exponent, 0.0, rounding)
        assert profile.duration == pytest.approx(way[-1] / ceiling + rounding, rel=1e-4, abs=4e-6)
        half = profile.at(profile.duration / 2)
        assert half.way == pytest.approx(way[-1] / 2, rel=1e-4)
        assert profile.at(profile.duration).way == pytest.approx(way[-1], rel=1e-12)


@pytest.mark.parametrize('ramp', [1e3, 1e7, 1e9, 1e11, 1e13, 1e15, 1e17, 1e200, 1.7e308, AT_ONCE])
def test_a_metre_at_half_a_metre_a_second_takes_two_seconds(ramp):
    profile = plain(1.0, 0.5, ramp)
    assert profile.duration == pytest.approx(2.0 + 0.5 / ramp, rel=1e-13)
    assert profile.top_speed == pytest.approx(0.5)
    assert profile.at(profile.duration / 2) == pytest.approx((0.5, 0.5, 0.0))
    assert profile.at(profile.duration).speed == 0.0


@pytest.mark.parametrize('ramp', [1e-300, 1e-100, 1e-9])
def test_a_ramp_so_gentle_makes_a_triangle(ramp):
    assert plain(1.0, 0.5, ramp).duration == pytest.approx(2.0 * sqrt(1.0 / ramp), rel=1e-12)


@given(st.floats(-3.0, 300.0), st.floats(0.0, 50.0))
def test_a_harder_ramp_of_an_s_curve_never_takes_longer(exponent, more):
    gentle = plain(3.0, 1.0, 10.0**exponent, rounding=0.3).duration
    hard = plain(3.0, 1.0, 10.0 ** min(exponent + more, 300.0), rounding=0.3).duration
    assert hard <= gentle * (1.0 + 1e-12)


@given(ways(), st.floats(0.0, 2.0))
def test_the_lowest_nearby_is_that_of_a_look_at_each(way_and_values, reach):
    """Of the nodes within reach, and one more at either end."""
    way, values = way_and_values
    found = speed_plan._lowest_within(way, values, np.full(len(way), reach))  # noqa: SLF001
    for i, lowest in enumerate(found):
        near = np.flatnonzero((way >= way[i] - reach) & (way <= way[i] + reach))
        assert lowest == values[max(near[0] - 1, 0) : near[-1] + 2].min()


def test_before_a_bend_a_rounded_profile_slows_down_no_sooner_than_it_must():
    """For 0.4 m/s at 2.5 m of 6: the mean over 0.4 s looks 0.2 s of way ahead and back, no more."""
    way = np.linspace(0.0, 6.0, 121)
    ceiling = np.where(np.abs(way - 2.5) < 0.1, 0.4, 1.0)
    durations = [plan_speed(way, ceiling, 1.0, 0.0, rounding).duration for rounding in (0.0, 0.4)]
    assert durations == pytest.approx([7.585, 8.885], abs=1e-6)
