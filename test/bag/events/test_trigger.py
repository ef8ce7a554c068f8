"""Triggers: the moments at which conditions begin to be met, batch after batch."""

from __future__ import annotations

import struct

from agv_motion.bag.columns.condition import condition
from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.events.trigger import Trigger


def connection(topic, definition='float64 data'):
    return Connection(topic, 'a/msg/F', definition, 'ros2msg', 'cdr', '', ())


def numbers(topic, *values, start=0):
    of = connection(topic)
    return [
        Message(of, start + i, struct.pack('<4sd', b'\0\1\0\0', value), 0, 0)
        for i, value in enumerate(values)
    ]


def bound(text, topic):
    trigger = Trigger(condition(text))
    trigger.bind(connection(topic))
    return trigger


def test_a_moment_is_where_a_condition_begins_to_be_met_also_across_batches():
    trigger = bound('/turrets/residual > 0.02', '/turrets/residual')
    found = trigger.moments(numbers('/turrets/residual', 0.0, 0.03, 0.04, 0.0, 0.5))
    assert [(m.stamp, m.reason) for m in found] == [
        (1, '/turrets/residual > 0.02'), (4, '/turrets/residual > 0.02'),
    ]  # fmt: skip
    assert trigger.moments(numbers('/turrets/residual', 0.6, float('nan'), start=5)) == []
    assert [m.stamp for m in trigger.moments(numbers('/turrets/residual', 0.6, start=7))] == [7]
    assert trigger.moments([]) == []


def test_the_first_message_may_meet_it():
    trigger = bound('/residual/data >= 1', '/residual')
    assert [m.stamp for m in trigger.moments(numbers('/residual', 1.0, 2.0))] == [0]


def test_the_longest_topic_that_has_the_field_is_watched():
    trigger = Trigger(condition('/a/b/data > 1'))
    assert [trigger.fits(t) for t in ('/a', '/a/b', '/a/b/data', '/a/c', '/')] == [
        True, True, True, False, False,
    ]  # fmt: skip
    trigger.bind(connection('/a'))
    assert trigger.connection is None
    assert 'b.data' in trigger.problem
    trigger.bind(connection('/a/b'))
    assert trigger.connection.topic == '/a/b'
    assert trigger.problem == ''
    trigger.bind(connection('/a'))
    assert trigger.connection.topic == '/a/b'


def test_a_damaged_message_is_told_and_the_next_is_watched():
    trigger = bound('/residual > 1', '/residual')
    (torn,) = numbers('/residual', 5.0)
    assert trigger.moments([torn._replace(data=torn.data[:7])]) == []
    assert trigger.problem
    assert len(trigger.moments(numbers('/residual', 5.0))) == 1
    assert trigger.problem == ''


def test_a_topic_that_comes_again_goes_on_and_another_begins_anew():
    trigger = bound('/a/b > 1', '/a/b')
    assert len(trigger.moments(numbers('/a/b', 5.0))) == 1
    trigger.bind(connection('/a/b'))
    assert trigger.moments(numbers('/a/b', 5.0, start=1)) == []
    inner = Trigger(condition('/a/b/data > 1'))
    inner.bind(connection('/a', 'B b\n===\nMSG: a/B\nfloat64 data'))
    assert inner.connection.topic == '/a'
    assert len(inner.moments(numbers('/a', 5.0))) == 1
    inner.bind(connection('/a/b'))
    assert len(inner.moments(numbers('/a/b', 5.0, start=1))) == 1


def test_a_misfit_beside_a_topic_that_fits_is_no_problem():
    trigger = bound('/a/b/data > 1', '/a/b')
    trigger.bind(connection('/a/b/data', 'string other'))
    assert (trigger.connection.topic, trigger.problem) == ('/a/b', '')
