"""Who drives: rank, time-out, latch, lock, the dead-man, clocks that leap."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.arbitration import Arbiter, TwistSource
from agv_motion.arbitration.choice import HeldStop, Hold, Verdict
from agv_motion.arbitration.source import DRIVERS, RANKED
from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.planar import FASTEST, REST, Twist

TIMEOUTS = dict.fromkeys(TwistSource, 1.0) | {TwistSource.MANUAL: 0.25}
"""Exact in binary: what is silent for its time-out is silent."""
A, B = Twist(0.1, 0.0, 0.2), Twist(-0.3, 0.1, 0.0)
BELOW = [source for source in DRIVERS if source is not TwistSource.MANUAL]


def arbiter(hold=None):
    return Arbiter(TIMEOUTS, *([hold] if hold else []))


def test_the_sources_by_rank():
    assert [one.value for one in RANKED] == ['stop', 'manual', 'page', 'route', 'sequence', 'agent']


def test_nobody_drives_before_anybody_speaks():
    choice = arbiter().choose(0.0)
    assert (choice.twist, choice.driver, choice.at_once) == (REST, None, False)
    assert {one.verdict for one in choice.standings.values()} == {Verdict.NEVER}


@pytest.mark.parametrize('place', range(len(DRIVERS) - 1))
def test_the_higher_of_two_drives_whoever_came_first(place):
    high, low = DRIVERS[place : place + 2]
    for order in ((high, low), (low, high)):
        found = arbiter()
        for source in order:
            found.receive(source, A if source is high else B, 0.0)
        choice = found.choose(0.125)
        assert (choice.twist, choice.driver) == (A, high)
        assert choice.standings[high] == (Verdict.DRIVES, '', 0.125)
        assert choice.standings[low] == (Verdict.OUTRANKED, f'{high.value} comes first', 0.125)


@pytest.mark.parametrize('source', DRIVERS)
def test_a_source_counts_until_its_time_out_and_no_longer(source):
    found, limit = arbiter(), TIMEOUTS[source]
    found.receive(source, A, 8.0)
    assert found.choose(8.0).driver is source
    assert found.choose(8.0 + 0.99 * limit).twist == A
    after = found.choose(8.0 + limit)
    assert after.twist == REST
    assert after.standings[source].verdict is (
        Verdict.LOST if source is TwistSource.MANUAL else Verdict.SILENT
    )
    assert after.standings[source].age == limit


@pytest.mark.parametrize('leap', [-1e9, -1e-9])
def test_who_seems_to_have_spoken_in_the_future_is_silent(leap):
    found = arbiter()
    found.receive(TwistSource.AGENT, A, 8.0)
    assert found.choose(8.0 + leap).driver is None


def test_one_who_keeps_saying_zero_drives_and_his_silence_hands_over():
    found = arbiter()
    found.receive(TwistSource.ROUTE, REST, 0.0)
    found.receive(TwistSource.AGENT, A, 0.5)
    assert (found.choose(0.5).driver, found.choose(0.5).twist) == (TwistSource.ROUTE, REST)
    assert (found.choose(1.0).driver, found.choose(1.0).twist) == (TwistSource.AGENT, A)


def test_stop_holds_at_once_and_until_it_is_released():
    found = arbiter()
    found.receive(TwistSource.MANUAL, A, 0.0)
    found.receive(TwistSource.AGENT, B, 0.0)
    found.stop('somebody fell', 7.0)
    found.stop('again', 9.0)
    choice = found.choose(0.125)
    assert (choice.twist, choice.driver, choice.at_once) == (REST, TwistSource.STOP, True)
    assert choice.hold.stop == HeldStop('somebody fell', 7.0)
    for source in (TwistSource.MANUAL, TwistSource.AGENT):
        assert choice.standings[source][:2] == (Verdict.STOPPED, 'STOP holds until released')
    found.receive(TwistSource.AGENT, B, 99.0)
    assert found.choose(99.0).twist == REST
    found.release()
    assert (found.choose(99.0).driver, found.choose(99.0).at_once) == (None, False)
    found.receive(TwistSource.AGENT, B, 99.5)
    assert found.choose(99.5).twist == B


@pytest.mark.parametrize('number', [0.0, nan, inf])
def test_whatever_comes_from_stop_latches(number):
    found = arbiter()
    found.receive(TwistSource.STOP, Twist(number, 0.0, 0.0), 7.0)
    assert found.choose(99.0).hold.stop == HeldStop('asked for', 7.0)


def test_a_stop_from_before_holds_from_the_start():
    found = arbiter(Hold(HeldStop('before', 1.0)))
    found.receive(TwistSource.MANUAL, A, 0.0)
    assert (found.choose(0.0).twist, found.choose(0.0).at_once) == (REST, True)


@pytest.mark.parametrize('locked', DRIVERS)
@pytest.mark.parametrize('speaks', DRIVERS)
def test_a_lock_lets_drive_whom_it_is_for_and_those_above(locked, speaks):
    found = arbiter()
    found.lock(locked)
    found.receive(speaks, A, 0.0)
    choice = found.choose(0.125)
    above = DRIVERS.index(speaks) <= DRIVERS.index(locked)
    assert choice.twist == (A if above else REST)
    assert choice.driver is (speaks if above else locked)
    assert not choice.at_once
    if not above:
        assert choice.standings[locked][:2] == (Verdict.HOLDS, 'it speaks, or is released')
        told = (Verdict.LOCKED_OUT, f'{locked.value} is locked until released')
        assert choice.standings[speaks][:2] == told
    found.unlock(locked)
    assert found.choose(0.125).driver is speaks


def test_of_two_locks_the_higher_counts():
    found = arbiter()
    found.lock(TwistSource.ROUTE)
    found.lock(TwistSource.PAGE)
    found.receive(TwistSource.ROUTE, A, 0.0)
    assert found.choose(0.0).driver is TwistSource.PAGE
    found.unlock(TwistSource.PAGE)
    assert found.choose(0.0).driver is TwistSource.ROUTE
    assert found.hold.locks == {TwistSource.ROUTE}


def test_a_dead_man_that_was_let_go_holds_all_below():
    found = arbiter()
    found.receive(TwistSource.MANUAL, A, 0.0)
    found.receive(TwistSource.AGENT, B, 0.0)
    found.choose(0.125)
    choice = found.choose(0.25)
    assert (choice.twist, choice.driver, choice.at_once) == (REST, TwistSource.MANUAL, True)
    assert choice.standings[TwistSource.MANUAL].verdict is Verdict.LOST
    assert choice.standings[TwistSource.AGENT][:2] == (Verdict.LOCKED_OUT, 'manual was let go')
    found.receive(TwistSource.AGENT, B, 50.0)
    assert found.choose(50.0).at_once


def test_a_dead_man_that_speaks_anew_drives_and_hands_over_by_a_zero():
    found = arbiter()
    found.receive(TwistSource.MANUAL, A, 0.0)
    found.choose(1.0)
    found.receive(TwistSource.MANUAL, B, 2.0)
    assert (found.choose(2.0).twist, found.choose(2.0).at_once) == (B, False)
    found.receive(TwistSource.MANUAL, REST, 2.1)
    found.receive(TwistSource.AGENT, A, 2.1)
    assert (found.choose(2.2).driver, found.choose(2.2).twist) == (TwistSource.MANUAL, REST)
    assert (found.choose(2.4).driver, found.choose(2.4).at_once) == (TwistSource.AGENT, False)


def test_a_dead_man_that_was_let_go_is_released_by_a_person():
    found = arbiter()
    found.receive(TwistSource.MANUAL, A, 0.0)
    found.receive(TwistSource.AGENT, B, 0.75)
    found.choose(1.0)
    found.unlock(TwistSource.MANUAL)
    assert (found.choose(1.0).driver, found.choose(1.0).twist) == (TwistSource.AGENT, B)


@pytest.mark.parametrize('source', BELOW)
def test_the_silence_of_others_holds_nothing(source):
    found = arbiter()
    found.receive(source, A, 0.0)
    assert not found.choose(1.0).at_once
    assert found.choose(1.0).driver is None


def test_an_old_zero_stops_but_is_no_sign_of_life():
    found = arbiter()
    found.receive(TwistSource.ROUTE, A, 0.0)
    found.rest(TwistSource.ROUTE)
    found.rest(TwistSource.AGENT)
    assert (found.choose(0.5).twist, found.choose(0.5).driver) == (REST, TwistSource.ROUTE)
    assert found.choose(1.0).driver is None


def test_what_was_said_before_is_forgotten_and_a_dead_man_that_drove_is_lost():
    found = arbiter()
    found.receive(TwistSource.AGENT, B, 0.0)
    found.forget()
    assert found.choose(0.0).driver is None
    found.receive(TwistSource.MANUAL, A, 0.0)
    found.forget()
    assert (found.choose(0.0).driver, found.choose(0.0).at_once) == (TwistSource.MANUAL, True)


@pytest.mark.parametrize('number', [nan, inf, -inf, 1.01 * FASTEST, -1e308])
@pytest.mark.parametrize('place', range(3))
def test_what_is_no_twist_is_refused_and_changes_nothing(number, place):
    found = arbiter()
    found.receive(TwistSource.AGENT, A, 0.0)
    twist = Twist(*(number if i == place else 0.0 for i in range(3)))
    with pytest.raises(SignalError, match='twist'):
        found.receive(TwistSource.AGENT, twist, 5.0)
    assert found.choose(0.5).twist == A
    assert found.choose(5.0).driver is None


def test_a_twist_at_the_limit_of_belief_passes():
    found = arbiter()
    found.receive(TwistSource.AGENT, Twist(FASTEST, 0.0, -FASTEST), 0.0)
    assert found.choose(0.0).twist == (FASTEST, 0.0, -FASTEST)


@pytest.mark.parametrize('timeout', [0.0, -1.0, nan])
def test_a_time_out_that_is_none_is_refused(timeout):
    with pytest.raises(ConfigurationError, match='time-out of page'):
        Arbiter(TIMEOUTS | {TwistSource.PAGE: timeout})


TIMES = st.floats(0.0, 3.0)
SAID = st.tuples(st.sampled_from(DRIVERS), st.sampled_from([REST, A, B]), TIMES)


@given(st.lists(SAID, max_size=20), st.sets(st.sampled_from(DRIVERS)), st.booleans(), TIMES)
def test_laws(said, locks, stopped, wait):
    found = arbiter()
    for source in locks:
        found.lock(source)
    last, now = {}, 0.0
    for source, twist, pause in said:
        now += pause
        found.choose(now)
        found.receive(source, twist, now)
        last[source] = twist, now
    now += wait
    if stopped:
        found.stop('now', now)
    choice = found.choose(now)
    speaking = [s for s in DRIVERS if s in last and now - last[s][1] < TIMEOUTS[s]]
    held = choice.hold.locks | choice.hold.lost
    if stopped:
        assert choice.driver is TwistSource.STOP
    else:
        top = next((s for s in DRIVERS if s in speaking or s in held), None)
        assert choice.driver is top  # nobody above it speaks or is held
    assert choice.twist == (last[choice.driver][0] if choice.driver in speaking else REST)
    assert choice.hold.lost <= {TwistSource.MANUAL}
    assert choice.at_once is (stopped or choice.driver in choice.hold.lost)
    assert set(choice.standings) == set(TwistSource)
    drives = [s for s, one in choice.standings.items() if one.verdict is Verdict.DRIVES]
    assert drives == ([choice.driver] if choice.driver in [TwistSource.STOP, *speaking] else [])
