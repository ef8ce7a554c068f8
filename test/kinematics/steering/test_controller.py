"""The steering planner at work: time, turrets turned by hand, cables, the end of a stop."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from math import cos, inf, isfinite, nan, pi, tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import AgvMotionError, ConfigurationError, SignalError
from agv_motion.kinematics.steering.controller import SteeringController
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.readings import LOST_TURRET, MOST_TURNS
from agv_motion.kinematics.steering.state import Limiter
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import REST, Twist

PAIR = Turrets([(0.5, 0.0), (-0.5, 0.0)])
LIMITS = SteeringLimits(
    max_wheel_speed=0.5, steering_rate=2.0, steering_acceleration=50.0, wheel_acceleration=2.0
)
AHEAD = Twist(0.3, 0.0, 0.0)


def drive(unwind_after=0.0):
    return SteeringController(PAIR, LIMITS, 0.1, unwind_after)


def steps(one, count, now=0.0):
    """Let so many periods pass; return the time after them."""
    for _ in range(count):
        now += 0.1
        assert one.step(now, 0.05)
    return now


def test_nothing_is_commanded_while_nothing_is_known_or_wanted():
    one = drive()
    assert not one.step(0.0, 0.05)
    one.set_target(REST)
    assert one.setpoints is None
    assert one.overturned() == ''
    one.set_target(AHEAD)
    assert one.setpoints.angles == [0.0, 0.0]


def test_a_step_that_is_not_due_waits():
    one = drive()
    one.set_target(AHEAD)
    assert one.step(1.0, 0.05)
    speeds = list(one.setpoints.speeds)
    assert not one.step(1.04, 0.05)
    assert one.setpoints.speeds == speeds
    assert one.step(1.06, 0.05)
    assert one.setpoints.speeds > speeds


def test_after_a_gap_or_a_leap_back_one_period_counts():
    for leap in (50.0, -50.0):
        one = drive()
        one.set_target(AHEAD)
        now = steps(one, 1)
        before = one.setpoints.speeds[0]
        assert one.step(now + leap, 0.05)
        assert one.setpoints.speeds[0] - before <= LIMITS.wheel_acceleration * 0.1 + 1e-12


@pytest.mark.parametrize('rolls', [False, True])
def test_turrets_that_turn_stop_as_hard_as_they_could_when_they_began(rolls):
    """At 0.01 rad/s2, 2 rad/s would lead 200 rad on, far beyond the cables: 9.42 rad."""
    one = drive()
    one.set_target(AHEAD)
    now = steps(one, 10 if rolls else 0)
    one.set_target(Twist(0.0, 0.3, 0.0))
    now = steps(one, 4, now)
    assert max(one.setpoints.rates) > 1.0
    gentle = replace(LIMITS, steering_acceleration=0.01, max_wheel_speed=0.2)
    one.planner.limits = gentle
    for _ in range(60):
        now = steps(one, 1, now)
        assert max(one.setpoints.angles) <= pi / 2 + 1e-9
        assert max(one.setpoints.rates) <= LIMITS.steering_rate + 1e-9
    assert one.setpoints.angles == pytest.approx([pi / 2] * 2)
    assert one.setpoints.speeds == pytest.approx([0.2] * 2)
    one.set_target(AHEAD)
    now = steps(one, 1, now)
    assert max(map(abs, one.setpoints.rates)) <= 0.01 * 0.1 + 1e-12


def test_a_turret_turned_by_hand_at_rest_is_taken_from_where_it_stands():
    one = drive()
    one.set_measured([0.0, 0.0])
    now = steps(one, 2)
    one.set_measured([0.0, LOST_TURRET - 0.01])
    now = steps(one, 1, now)
    assert one.setpoints.angles == [0.0, 0.0]
    one.set_measured([0.0, LOST_TURRET + 0.01])
    steps(one, 1, now)
    assert one.setpoints.angles == pytest.approx([0.0, LOST_TURRET + 0.01])


def test_it_rolls_as_far_as_the_worst_turret_has_turned():
    one = drive()
    one.set_measured([0.0, 0.0])
    assert one.share() == 1.0
    one.set_target(AHEAD)
    steps(one, 5)
    one.set_measured([0.0, 1.0])
    assert one.share() == pytest.approx(cos(1.0))


def test_cables_are_unwound_when_asked_or_after_a_rest():
    for unwind_after in (0.0, 2.0):
        one = drive(unwind_after)
        one.set_measured([pi, 0.0])
        now = steps(one, 10)
        assert one.setpoints.angles == [pi, 0.0]
        if not unwind_after:
            assert one.unwind() == 'unwinding, the furthest turret by 180 deg'
        for _ in range(40):
            now = steps(one, 1, now)
            one.set_measured(list(one.setpoints.angles))
        assert one.setpoints.angles == pytest.approx([0.0, 0.0])
        assert not one.unwinding


def test_cables_are_not_unwound_while_driving_or_where_there_is_nothing_to_do():
    one = drive()
    assert one.unwind().startswith('nothing to unwind')
    one.set_measured([pi, pi])
    one.set_target(AHEAD)
    with pytest.raises(ConfigurationError, match='zero cmd_vel'):
        one.unwind()


def test_who_wants_to_drive_or_to_stop_ends_the_unwinding():
    for end in (lambda one: one.set_target(AHEAD), lambda one: one.stop()):
        one = drive()
        one.set_measured([pi, pi])
        one.unwind()
        one.set_target(REST)
        assert one.unwinding
        end(one)
        assert not one.unwinding


def test_turrets_that_turn_for_a_twist_are_not_resting():
    """From 3 rad to a quarter turn at 2 rad/s: longer than the rest after which it is unwound."""
    one, now = drive(unwind_after=0.3), 0.0
    one.set_measured([3.0, 3.0])
    one.set_target(Twist(0.0, 0.3, 0.0))
    for _ in range(7):
        now = steps(one, 1, now)
        assert not one.unwinding
        assert one.setpoints.limiter is Limiter.ALIGNING
    assert one.setpoints.angles == pytest.approx([1.6, 1.6], abs=0.04)


def test_a_stop_holds_the_angles_and_the_next_start_takes_them_as_they_are():
    one = drive()
    one.set_measured([0.0, 0.0])
    one.set_target(Twist(0.2, 0.2, 0.0))
    steps(one, 20)
    angles = list(one.setpoints.angles)
    one.stop()
    assert one.setpoints.speeds == [0.0, 0.0]
    assert one.setpoints.angles == angles
    one.set_measured([0.3, 0.3])
    one.start_anew()
    assert one.setpoints.angles == pytest.approx([0.3, 0.3])


MOST = LIMITS.turn_limit * tau


@pytest.mark.parametrize('angle', [24.0, -24.0, 11.0, 12.7, MOST + 0.001, 70.0])
@pytest.mark.parametrize('twist', [AHEAD, Twist(0.0, 0.2, 0.3), Twist(0.0, 0.0, -0.4)])
def test_a_turret_beyond_its_limit_turns_back_before_the_platform_rolls(angle, twist):
    one, now, before = drive(), 0.0, abs(angle)
    one.set_measured([angle, 0.3])
    assert f'turret 0 stands at {angle:.4g} rad, beyond its turn_limit of 9.425' in one.overturned()
    one.set_target(twist)
    while one.overturned():
        now = steps(one, 1, now)
        assert one.setpoints.speeds == [0.0, 0.0]
        assert abs(one.setpoints.angles[0]) <= before + 1e-12
        before = abs(one.setpoints.angles[0])
        assert now < 60.0
    now = steps(one, 100, now)
    assert one.setpoints.twist(PAIR) == pytest.approx(twist, abs=1e-6)
    assert max(map(abs, one.setpoints.angles)) <= MOST + 1e-9


def test_at_rest_it_is_unwound_all_the_way():
    one, now = drive(unwind_after=1.0), 0.0
    one.set_measured([-24.0, 0.0])
    now = steps(one, 400, now)
    assert max(map(abs, one.setpoints.angles)) <= pi / 2 + 1e-9
    assert not one.overturned()


@pytest.mark.parametrize('angle', [1e9, -1e17, 1.7e308, nan, -inf, MOST + MOST_TURNS * tau + 0.1])
def test_an_angle_that_no_cable_allows_is_refused_and_the_platform_stands(angle):
    one = drive()
    with pytest.raises(SignalError, match=r'turret 1 stands at .* look at the encoder'):
        one.set_measured([0.0, angle])
    one.set_target(AHEAD)
    assert one.setpoints is None
    assert not one.step(0.1, 0.05)
    one.set_measured([0.1, -0.1])
    one.set_target(AHEAD)
    steps(one, 60, 0.1)
    assert one.setpoints.twist(PAIR) == pytest.approx(AHEAD, abs=1e-6)


@given(st.floats())
def test_an_unbelievable_angle_on_the_way_changes_nothing(angle):
    one = drive()
    one.set_measured([0.0, 0.0])
    one.set_target(AHEAD)
    now = steps(one, 10)
    planned, measured = list(one.setpoints.angles), one.measured
    try:
        one.set_measured([0.0, angle])
    except SignalError:
        assert one.measured is measured
    assert one.setpoints.angles == planned
    assert 0.0 <= one.share() <= 1.0
    steps(one, 5, now)
    assert all(map(isfinite, one.setpoints.speeds))


ANGLES = st.one_of(st.floats(-12.0, 12.0), st.floats(-100.0, 100.0), st.floats())
TWISTS = st.builds(Twist, *[st.one_of(st.just(0.0), st.floats(-1.0, 1.0))] * 3)
EVENTS = st.lists(
    st.one_of(
        st.tuples(st.just('set_measured'), st.lists(ANGLES, min_size=2, max_size=2)),
        st.tuples(st.just('set_target'), TWISTS),
        st.tuples(st.sampled_from(['unwind', 'start_anew', 'stop']), st.none()),
    ),
    max_size=12,
)


@settings(max_examples=150)
@given(EVENTS)
def test_whatever_the_turrets_tell_the_wheels_keep_their_limits(events):
    one, now = drive(unwind_after=0.5), 0.0
    for what, value in events:
        with suppress(AgvMotionError):
            getattr(one, what)(*(() if value is None else (value,)))
        before = list(one.setpoints.speeds) if one.setpoints else [0.0, 0.0]
        for _ in range(8):
            now += 0.1
            if not one.step(now, 0.05):
                continue
            assert all(map(isfinite, (*one.setpoints.angles, *one.setpoints.speeds, one.share())))
            for speed, last in zip(one.setpoints.speeds, before, strict=True):
                assert abs(speed) <= LIMITS.max_wheel_speed + 1e-9
                assert abs(abs(speed) - abs(last)) <= LIMITS.wheel_acceleration * 0.1 + 1e-9
            before = list(one.setpoints.speeds)


def test_turrets_that_are_seen_to_have_turned_let_the_wheels_speed_up_no_faster_than_they_may():
    """A reading that leaps from a quarter turn off to where it should be is no step of speed."""
    one, rolled = drive(), 0.0
    one.set_measured([0.0, 0.0])
    one.set_target(AHEAD)
    now = steps(one, 20)
    one.set_measured([0.0, pi / 2])
    now = steps(one, 1, now)
    assert one.share() == pytest.approx(0.0, abs=1e-12)
    one.set_measured([0.0, 0.0])
    for _ in range(5):
        now = steps(one, 1, now)
        speed = one.share() * one.setpoints.speeds[1]
        assert rolled <= speed <= rolled + LIMITS.wheel_acceleration * 0.1 + 1e-9
        rolled = speed
    assert rolled == pytest.approx(0.3)


def test_turrets_that_stand_as_they_should_take_nothing_off_the_speed():
    """Also at the step in which the wheels gain exactly what they may."""
    one, now = drive(), 0.0
    one.set_measured([0.0, 0.0])
    one.set_target(Twist(0.5, 0.0, 0.0))
    for _ in range(6):
        now = steps(one, 1, now)
        one.set_measured(list(one.setpoints.angles))
        assert one.share() == 1.0
    assert one.setpoints.speeds == pytest.approx([0.5, 0.5])


def test_turrets_that_turn_are_not_astray():
    one = drive()
    one.set_measured([0.0, 0.0])
    one.set_target(Twist(0.0, 0.3, 0.0))
    now = steps(one, 2)
    one.set_measured([LOST_TURRET + 0.1, 0.0])
    before = one.setpoints.angles[1]
    steps(one, 1, now)
    assert one.setpoints.angles[1] > before > 0.0


@pytest.mark.parametrize('bad', [nan, inf, 1e200, -1001.0])
def test_a_target_beyond_any_robot_is_refused_and_the_last_one_holds(bad):
    one = drive()
    one.set_target(AHEAD)
    now = steps(one, 20)
    before = list(one.setpoints.speeds)
    for part in range(3):
        with pytest.raises(SignalError, match=r'twist .*(must be finite|look at the units)'):
            one.set_target(Twist(*(bad if i == part else 0.1 for i in range(3))))
    steps(one, 5, now)
    assert one.setpoints.speeds == pytest.approx(before)


@pytest.mark.parametrize('count', [0, 1, 3])
def test_angles_of_another_platform_are_refused(count):
    one = drive()
    for _ in range(2):  # before and after those of this one
        with pytest.raises(SignalError, match=f'{count} angles for 2 turrets: give one each'):
            one.set_measured([0.0] * count)
        one.set_measured([0.1, 0.2])
    assert one.measured == [0.1, 0.2]
