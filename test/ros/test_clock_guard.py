"""What a node says of its clock: to wait for a simulation that begins is no error."""

from __future__ import annotations

from functools import partial

import pytest

from agv_motion.ros.clock_guard import LOOK_PERIOD, WAITS, ClockGuard


class Node:
    """A node that keeps what is logged, at times that the test tells."""

    def __init__(self):
        self.active, self.time, self.now, self.told = True, 0.0, 100.0, []
        self.is_simulated, self.clocks = True, ''
        self.info = partial(self._log, 'info')
        self.warning = partial(self._log, 'warning')
        self.error = partial(self._log, 'error')

    def _log(self, level, text):
        self.told.append((level, text))

    def crowd(self, topic):
        assert topic == '/clock'
        return self.clocks

    def seconds(self):
        return self.time

    def steady_seconds(self):
        return self.now


def looked(node, guard, looks, speed=0.0, period=LOOK_PERIOD):
    """Look at the clock, and return all that the node has said since it began."""
    for _ in range(looks):
        node.now += period
        node.time += speed * period
        guard.look()
    return node.told


def test_a_start_in_which_all_take_their_time_says_nothing():
    """However seldom a busy machine lets the node look."""
    node = Node()
    guard = ClockGuard(node)
    node.now += 60.0
    assert looked(node, guard, 20, period=3.0) == []
    assert guard.watch.fault
    node.time = 50.0
    assert looked(node, guard, 5, period=3.0) == []  # the first time, and long no second
    assert guard.watch.fault
    assert looked(node, guard, 20, speed=60.0) == []
    assert not guard.watch.fault


def test_a_simulation_that_never_begins_is_told_once_with_what_to_do():
    node = Node()
    guard = ClockGuard(node)
    assert looked(node, guard, WAITS - 1) == []
    [(level, text)] = looked(node, guard, 500)
    assert level == 'warning'
    assert text == (
        'no time has come on /clock yet: waiting for it; does nobody simulate? use_sim_time:=false'
    )
    assert looked(node, guard, 10, speed=1.0)[1:] == [('info', 'the clock runs well: going on')]


def test_a_simulation_that_ran_and_stands_or_begins_anew_at_zero_is_an_error():
    node = Node()
    guard = ClockGuard(node)
    looked(node, guard, 30, speed=1.0)
    [(level, text)] = looked(node, guard, 30)
    assert (level, text[:22]) == ('error', 'the clock stands still')
    looked(node, guard, 80, speed=1.0)
    node.time = 0.0
    told = looked(node, guard, 5)
    assert told[2:] == [('error', 'the clock went back to zero: standing still until it runs well')]


@pytest.mark.parametrize('is_simulated', [True, False])
def test_who_tell_the_time_together_are_named_where_it_leaps(is_simulated):
    node = Node()
    guard = ClockGuard(node)
    node.time, node.is_simulated = 1000.0, is_simulated
    looked(node, guard, 30, speed=1.0)
    assert not guard.watch.fault
    node.clocks, node.time = '/ash/simulator, /oak/simulator', node.time - 500.0
    [(level, text)] = looked(node, guard, 1, speed=1.0)
    assert level == 'error'
    assert text.startswith('the clock leapt back by 500 s: standing still until it runs well')
    named = '; /ash/simulator, /oak/simulator all tell the time on /clock: let only one do so'
    assert text.endswith(named if is_simulated else 'well')
