"""Probes with a topic each: values of one time come together, late ones do not hold up others."""

from __future__ import annotations

from math import isnan

from hypothesis import given, settings
from hypothesis import strategies as some

from agv_motion.probe.sources.topic_rounds import TopicRounds


def test_a_round_is_whole_once_each_probe_has_spoken():
    rounds = TopicRounds(3, 15.0)
    assert rounds.add(2, 100.0, 3.0, 0.0) == []
    assert rounds.add(0, 101.0, 1.0, 1.0) == []
    ((time, values, _),) = rounds.add(1, 99.0, 2.0, 2.0)
    assert (time, values) == (101.0, (1.0, 2.0, 3.0))
    assert rounds.overdue(1e6) == []


def test_a_probe_that_is_silent_holds_up_none():
    rounds = TopicRounds(2, 15.0)
    rounds.add(0, 100.0, 1.0, 0.0)
    ((time, values, _),) = rounds.add(0, 130.0, 1.5, 30.0)
    assert time == 100.0
    assert values[0] == 1.0
    assert isnan(values[1])
    assert rounds.overdue(45.0) == []
    ((time, values, _),) = rounds.overdue(46.0)
    assert (time, values[0]) == (130.0, 1.5)


def test_values_of_different_times_are_not_brought_together():
    rounds = TopicRounds(2, 15.0)
    rounds.add(0, 100.0, 1.0, 0.0)
    ((time, values, _),) = rounds.add(1, 116.0, 2.0, 1.0)
    assert (time, values[0]) == (100.0, 1.0)
    assert isnan(values[1])


@settings(deadline=None, max_examples=60)
@given(some.lists(some.tuples(some.integers(0, 2), some.integers(0, 300)), max_size=40))
def test_no_value_is_lost_and_none_told_twice(told):
    rounds, lines = TopicRounds(3, 15.0), []
    for number, (probe, time) in enumerate(told):
        lines += rounds.add(probe, float(time), float(number), 0.0)
    lines += rounds.overdue(1e9)
    values = [value for line in lines for value in line.values if not isnan(value)]
    assert sorted(values) == list(range(len(told)))
