"""Clocks that leap, stand, go to and fro or run at any speed, beside one that cannot."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.clock_watch import CALM, WAITING, ClockWatch

PERIOD = 0.1


def looked(watch, times, steady=100.0):
    """Return what is wrong after each look, ten a second."""
    faults = []
    for i, time in enumerate(times):
        watch.look(time, steady + i * PERIOD)
        faults.append(watch.fault)
    return faults


def running(begin, looks, speed=1.0):
    """Return the times of a clock that runs well."""
    return [begin + speed * PERIOD * i for i in range(looks)]


@given(
    speed=st.sampled_from([0.1, 1.0, 10.0, 60.0, 1000.0]),
    jitter=st.lists(st.floats(-0.3, 0.3), min_size=50, max_size=50),
)
def test_a_clock_that_runs_at_any_speed_is_believed(speed, jitter):
    """However uneven the looks at it: the clock is behind or ahead by a third of a look."""
    times = [1000.0 + speed * PERIOD * (i + shift) for i, shift in enumerate(jitter)]
    assert not any(looked(ClockWatch(), sorted(times)))


@pytest.mark.parametrize('speed', [1.0, 60.0])
@pytest.mark.parametrize(
    ('leap', 'word'),
    [(3600.0, 'ahead by 3.6e'), (-3600.0, 'back by 3.6e'), (-20.0, 'back'), (1e9, 'ahead')],
)
def test_a_leap_is_told_and_the_clock_believed_again_when_it_ran_well(speed, leap, word):
    watch = ClockWatch()
    times = running(1e6, 20, speed)
    after = running(times[-1] + leap, 20, speed)
    faults = looked(watch, times + after)
    assert not any(faults[:20])
    assert word in faults[20]
    calm = round(CALM / PERIOD)
    assert all(faults[20 : 20 + calm])
    assert not any(faults[21 + calm :])


def test_small_steps_of_a_time_server_are_no_leap():
    watch = ClockWatch()
    assert not any(looked(watch, [100.0, 100.1, 100.15, 100.25, 101.2, 101.3]))


def test_a_clock_that_stands_is_told_after_its_limit_and_goes_on():
    watch = ClockWatch(stands_after=0.35)
    faults = looked(watch, [*running(50.0, 5), *[50.4] * 10, *running(50.5, 10)])
    assert [bool(fault) for fault in faults] == [False] * 8 + [True] * 11 + [False] * 6
    assert 'stands still at 50.400 s' in faults[8]


def test_a_clock_that_has_not_begun_and_then_runs():
    faults = looked(ClockWatch(), [*[0.0] * 5, *running(7.0, 10, speed=60.0)])
    assert faults[:5] == ['no time has come on /clock yet'] * 5
    assert faults[5]
    assert not any(faults[6:])


def test_a_clock_that_has_told_one_time_has_not_begun_to_run():
    faults = looked(ClockWatch(0.5), [0.0, *[7.0] * 20, *running(8.0, 20)])
    assert set(faults[1:6]) == {'', WAITING[0]}
    assert set(faults[7:21]) == {WAITING[1]}
    assert not any(faults[-10:])


def test_a_simulation_that_stutters_as_it_begins_has_not_leapt():
    times = [0.0, 50.0, 50.1, 50.1, 50.2, 56.2, 68.2, 68.3, 80.0, *running(86.0, 30, speed=60.0)]
    assert not any(looked(ClockWatch(), times)[2:])


@pytest.mark.parametrize('looks', range(2, 12))
@pytest.mark.parametrize(('before', 'leap'), [([], 10.0), ([0.0], 500.0)])
def test_a_leap_soon_after_the_first_look_is_told(before, leap, looks):
    """The clock of a machine may be set while it starts; a simulation may be taken elsewhere."""
    times = [*before, *running(1000.0, looks)]
    assert 'ahead' in looked(ClockWatch(), [*times, times[-1] + 0.1 + leap])[-1]


def test_two_clocks_by_turns_are_never_believed():
    to_and_fro = [1000.0 + 0.1 * i + (500.0 if i % 2 else 0.0) for i in range(100)]
    assert all(looked(ClockWatch(), to_and_fro)[3:])


def test_a_simulation_that_is_sped_up_is_believed_soon_and_ages_count_by_its_speed():
    watch = ClockWatch()
    times = running(1000.0, 20)
    faults = looked(watch, times + running(times[-1] + 6.0, 30, speed=60.0))
    assert not any(faults[-10:])
    assert watch.speed == pytest.approx(60.0)


def test_who_distrusts_it_is_heard_until_it_ran_well():
    watch = ClockWatch()
    watch.look(10.0, 0.0)
    watch.distrust('/clock told -5 s', 0.05)
    faults = looked(watch, running(10.1, 8), steady=0.1)
    assert faults[0] == '/clock told -5 s'
    assert [bool(fault) for fault in faults] == [True] * 5 + [False] * 3


@pytest.mark.parametrize(('leap', 'told'), [(1.1, False), (1.5, True)])
def test_a_clock_may_gain_a_second_and_three_times_what_passed(leap, told):
    """Hand calculation: 1.0 s + 3 * 0.1 s at one look."""
    times = running(100.0, 10)
    assert bool(looked(ClockWatch(), [*times, times[-1] + leap])[-1]) is told


def test_a_clock_that_stands_while_it_is_distrusted_keeps_its_first_fault():
    watch = ClockWatch(stands_after=0.2)
    watch.look(9.9, -0.1)
    watch.look(10.0, 0.0)
    watch.distrust('/clock told -5 s', 0.05)
    watch.look(10.0, 0.3)
    assert watch.fault == '/clock told -5 s'
    watch.look(10.0, 0.7)
    assert 'stands still' in watch.fault


def test_a_leap_at_the_second_look_does_not_pass_for_speed():
    watch = ClockWatch()
    looked(watch, [1000.0, 1000.1, 1e6])
    assert watch.speed < 10.0


def test_ages_count_no_less_where_a_clock_runs_slowly():
    watch = ClockWatch()
    looked(watch, running(1000.0, 20, speed=0.1))
    assert watch.speed == 1.0


def test_a_clock_that_begins_anew_has_no_speed_of_before():
    watch = ClockWatch()
    looked(watch, [*running(1000.0, 20, speed=60.0), 0.0, *running(5.0, 3)])
    assert watch.speed == pytest.approx(1.0)
