"""Blocked: what does not move though told to; and all that must not be taken for it."""

from __future__ import annotations

import random
from math import floor, inf, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.blocked import BlockedGuard, BlockedParameters, BlockedWatch
from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.planar import REST, Pose, Twist, integrate

DT = 0.02
ORIGIN = Pose(0.0, 0.0, 0.0)
AHEAD = Twist(0.3, 0.0, 0.0)


def blocked_at(
    told, *, moves=None, measured=lambda pose, _: pose, seconds=60.0, period=DT, **parameters
):
    """Return when a robot is found blocked [s]; None if never.

    Args:
        told: Twist at a time.
        moves: Twist that it makes of it; none: it is held.
        measured: Makes of the true pose and the time what is measured.
        seconds: How long to look.
        period: From one pose to the next [s].
        parameters: When it is blocked.

    """
    watch, pose = BlockedWatch(BlockedParameters(**parameters), 0.15), ORIGIN
    for k in range(round(seconds / period)):
        twist = told(k * period)
        if watch.update(measured(pose, k * period), twist, period):
            return (k + 1) * period
        pose = integrate(pose, moves(twist) if moves else REST, period)
    return None


def noisy(deviation, seed=1):
    draw = random.Random(seed)  # noqa: S311 - noise, no secret
    return lambda pose, _: Pose(*(draw.gauss(part, deviation) for part in pose))


@pytest.mark.parametrize(
    'twist', [AHEAD, Twist(-0.3, 0.0, 0.0), Twist(0.0, 0.1, 0.0), Twist(0.0, 0.0, -0.5)]
)
def test_held_it_is_blocked_after_its_time(twist):
    assert blocked_at(lambda _: twist) == pytest.approx(5.0, abs=2 * DT)
    assert blocked_at(lambda _: twist, after=2.0) == pytest.approx(2.0, abs=2 * DT)


@pytest.mark.parametrize('deviation', [0.001, 0.01, 0.03])
def test_noise_of_the_pose_is_no_motion(deviation):
    for seed in range(5):
        assert 5.0 <= blocked_at(lambda _: AHEAD, measured=noisy(deviation, seed)) < 10.0


def test_told_little_it_is_given_the_time_that_a_coarse_pose_needs():
    """At 1 mm/s it takes 100 s until twice 0.05 m were told."""
    crawl = Twist(0.001, 0.0, 0.0)
    assert blocked_at(lambda _: crawl, seconds=200.0) == pytest.approx(100.0, abs=0.1)


def same(twist):
    return twist


def one_millimetre_a_second(twist):
    return Twist(min(twist.vx, 0.001), 0.0, 0.0)


def coarse(pose, _):
    return Pose(*(0.05 * floor(part / 0.05) for part in pose))


@pytest.mark.parametrize('measured', [lambda pose, _: pose, noisy(0.01), coarse])
@pytest.mark.parametrize(
    'twist',
    [
        Twist(0.001, 0.0, 0.0), Twist(0.3, 0.0, 0.0), Twist(0.0, 0.0, 0.3), Twist(0.0, 0.0, -0.01),
        Twist(0.1, 0.0, 1.0), Twist(0.0, 0.0, 2.0), Twist(0.05, -0.05, 0.0),
    ],
)  # fmt: skip
def test_what_moves_is_not_blocked_however_slowly_and_however_it_is_measured(twist, measured):
    always = lambda _: twist  # noqa: E731
    assert blocked_at(always, moves=same, measured=measured, seconds=300.0, period=0.1) is None


def test_a_robot_that_can_do_no_more_than_a_millimetre_a_second_is_not_blocked():
    slow = one_millimetre_a_second
    assert blocked_at(lambda _: AHEAD, moves=slow, seconds=300.0, period=0.1) is None


def test_a_delayed_pose_is_no_block():
    """2 s late: at first nothing seems to happen."""
    past = []

    def late(pose, _):
        past.append(pose)
        return past[max(len(past) - 100, 0)]

    assert blocked_at(lambda _: AHEAD, moves=same, measured=late) is None


def test_waiting_is_no_block_and_what_was_told_before_a_rest_does_not_count():
    assert blocked_at(lambda _: REST) is None
    assert blocked_at(lambda time: AHEAD if time % 6.0 < 4.0 else REST) is None


def test_a_short_zero_does_not_begin_the_time_anew():
    assert blocked_at(lambda time: REST if time % 1.0 < DT else AHEAD) < 6.0


def test_a_command_that_trembles_about_zero_tells_nothing():
    """A law on a noisy pose: 4 cm/s to and fro, at 50 Hz."""
    draw = random.Random(3)  # noqa: S311 - noise, no secret
    told = lambda _: Twist(draw.gauss(0.0, 0.04), 0.0, draw.gauss(0.0, 0.02))  # noqa: E731
    assert blocked_at(told, measured=noisy(0.01), seconds=60.0) is None


def test_it_may_be_switched_off():
    assert blocked_at(lambda _: AHEAD, after=0.0) is None


def test_blocked_on_the_way_it_says_what_was_told_and_what_was_done():
    watch, pose = BlockedWatch(BlockedParameters(), 0.15), ORIGIN
    for _ in range(100):
        assert not watch.update(pose, AHEAD, DT)
        pose = integrate(pose, AHEAD, DT)
    while not watch.update(pose, AHEAD, DT):
        pass
    assert watch.describe().startswith('told to move by 1.5')
    assert 'it moved by 0.0' in watch.describe()
    watch.restart()
    assert not watch.update(pose, AHEAD, DT)


@settings(max_examples=40)
@given(
    st.builds(Twist, st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-2.0, 2.0)),
    st.floats(0.5, 1.0),
)
def test_moving_is_never_blocked_and_standing_is_never_moving(twist, share):
    """For wheels that slip by up to a half, too."""
    slipped = Twist(*(share * part for part in twist))
    assert blocked_at(lambda _: twist, moves=lambda _: slipped, seconds=20.0) is None
    found = blocked_at(lambda _: twist, seconds=20.0)
    fast = abs(twist.vx) + abs(twist.vy) + 0.15 * abs(twist.wz) > 0.05
    assert not fast or found == pytest.approx(5.0, abs=2 * DT)


@pytest.mark.parametrize('bad', [nan, inf])
def test_what_is_no_number_is_refused(bad):
    watch = BlockedWatch(BlockedParameters(), 0.15)
    with pytest.raises(SignalError, match='must be finite'):
        watch.update(Pose(bad, 0.0, 0.0), AHEAD, DT)
    with pytest.raises(SignalError, match='must be finite'):
        watch.update(ORIGIN, AHEAD, bad)
    with pytest.raises(ConfigurationError, match='distance'):
        BlockedParameters(distance=bad)
    with pytest.raises(ConfigurationError, match=r'give 0\.5 s or more, or 0'):
        BlockedParameters(after=0.1)


def guarded(seconds, pose=ORIGIN, twist=AHEAD, guard=None, **parameters):
    guard = guard or BlockedGuard(BlockedParameters(**parameters), 0.15, 'ask a person')
    news = sum(guard.update(pose, twist, DT) for _ in range(round(seconds / DT)))
    return guard, news


def test_blocked_it_stays_so_until_a_person_lets_it_go_on():
    guard, news = guarded(1000.0)
    assert news == 1
    assert guard.reason.startswith('blocked: told to move by 1.5')
    assert guard.reason.endswith('ask a person')
    guard.release()
    assert guard.reason == ''
    guarded(4.9, guard=guard)
    assert guard.reason == ''
    guarded(0.2, guard=guard)
    assert guard.reason


def test_or_it_tries_again_by_itself():
    guard, news = guarded(6.0, then='retry', retry_after=3.0)
    assert guard.reason.endswith('trying again in 3 s')
    guarded(2.1, guard=guard)
    assert guard.reason == ''
    guarded(100.0, guard=guard)
    _, news = guarded(8.0, guard=guard)
    assert news == 1


def test_without_a_pose_nobody_is_blocked_but_who_was_stays_so():
    guard, _ = guarded(60.0, pose=None)
    assert guard.reason == ''
    guarded(6.0, guard=guard)
    guarded(6.0, guard=guard, pose=None)
    assert guard.reason
