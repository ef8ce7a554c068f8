"""A client that keeps up gets everything; one that does not gets the newest, and never a queue."""

from __future__ import annotations

import struct

from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.dashboard.foxglove.channels import Channels, GraphTopic
from agv_motion.dashboard.foxglove.frames import message_header
from agv_motion.dashboard.foxglove.subscriptions import Subscriptions


def topic(name, **more):
    return GraphTopic(name, 'std_msgs/msg/String', 'string data', **more)


def graph(*topics):
    channels = Channels()
    new, _ = channels.update({one.name: one for one in topics})
    return channels, new


def data(parts):
    """Return subscription and data of each message in pieces of frames."""
    assert len(parts) % 2 == 0
    heads, bodies = parts[::2], parts[1::2]
    for head, body in zip(heads, bodies, strict=True):
        assert head == message_header(*struct.unpack('<IQ', head[-12:]), len(body))
    return [(struct.unpack('<I', h[-12:-8])[0], b) for h, b in zip(heads, bodies, strict=True)]


def test_who_keeps_up_gets_all_that_came_also_several_of_one_topic():
    channels, (a, b) = graph(topic('/a'), topic('/b'))
    client = Subscriptions()
    assert client.add(10, a) == ''
    fresh = channels.take([('/a', 1, b'1'), ('/b', 2, b'x'), ('/a', 3, b'2'), ('/c', 3, b'?')])
    assert data(client.frames(fresh, channels.count)) == [(10, b'1'), (10, b'2')]
    assert client.add(11, b) == ''
    assert data(client.frames(channels.take([('/b', 4, b'y')]), channels.count)) == [(11, b'y')]
    assert not client.frames(channels.take([]), channels.count)


def test_who_does_not_keep_up_gets_the_newest_of_each_topic():
    channels, (a, b) = graph(topic('/a'), topic('/b'))
    client = Subscriptions()
    client.add(10, a)
    client.add(11, b)
    client.frames(channels.take([('/b', 0, b'old')]), channels.count)
    for count in range(1000):
        channels.take([('/a', count, b'%d' % count)])
        client.skip()
    assert client.is_behind
    assert data(client.frames((), channels.count)) == [(10, b'999')]
    assert not client.is_behind


def test_publishers_who_share_a_topic_do_not_hide_one_another():
    channels, (tf,) = graph(topic('/tf', slots=3))
    client = Subscriptions()
    client.add(1, tf)
    client.skip()
    channels.take([('/tf', n, bytes([n])) for n in range(9)])
    assert data(client.frames((), channels.count)) == [(1, b'\6'), (1, b'\7'), (1, b'\x08')]


def test_who_comes_late_gets_what_is_latched_and_only_that():
    channels, (a, b) = graph(topic('/a', latched=True, slots=2), topic('/b'))
    channels.take([('/a', n, bytes([n])) for n in range(5)] + [('/b', 9, b'x')])
    channels.take([])
    client = Subscriptions()
    client.add(1, a)
    client.add(2, b)
    assert client.is_behind
    assert data(client.frames((), channels.count)) == [(1, b'\3'), (1, b'\4')]
    fresh = channels.take([('/a', 9, b'new')])
    late = Subscriptions()
    late.add(3, a)
    assert data(late.frames(fresh, channels.count)) == [(3, b'\4'), (3, b'new')]
    assert data(client.frames(fresh, channels.count)) == [(1, b'new')]


def test_a_number_is_given_once_and_a_channel_chosen_once():
    _, (a, b) = graph(topic('/a'), topic('/b'))
    client = Subscriptions()
    client.add(1, a)
    assert 'subscription 1 is there already' in client.add(1, b)
    assert '/a is subscribed already, as 1' in client.add(2, a)
    assert client.remove(2) == 'there is no subscription 2'
    assert client.remove(1) == ''
    assert client.remove(1) == 'there is no subscription 1'
    assert client.add(1, b) == ''
    client.drop(b.info.id)
    client.drop(b.info.id)
    assert client.add(1, a) == ''


@settings(max_examples=40)
@given(st.lists(st.tuples(st.lists(st.integers(0, 4), max_size=6), st.booleans()), max_size=20))
def test_whatever_is_skipped_the_newest_of_each_topic_always_comes_and_nothing_twice(looks):
    channels, new = graph(*(topic(f'/{n}') for n in range(5)))
    client = Subscriptions()
    for channel in new:
        client.add(channel.info.id, channel)
    got, newest, count = [], {}, 0
    for names, takes in [*looks, ([], True)]:
        said = []
        for name in names:
            count += 1
            said.append((f'/{name}', count, b'%d' % count))
            newest[name + 1] = b'%d' % count
        fresh = channels.take(said)
        if takes:
            got += data(client.frames(fresh, channels.count))
        else:
            client.skip()
    assert len(set(got)) == len(got)
    assert dict(got) == newest
