"""Topics keep their numbers, and as many messages as they have publishers."""

from __future__ import annotations

from agv_motion.dashboard.foxglove.channels import MOST_SLOTS, Channels, GraphTopic


def topic(name, **more):
    return GraphTopic(name, 'std_msgs/msg/String', 'string data', **more)


def graph(*topics):
    channels = Channels()
    new, _ = channels.update({one.name: one for one in topics})
    return channels, new


def test_a_topic_that_comes_back_has_its_number_and_another_type_another():
    channels, (a,) = graph(topic('/a'))
    channels.take([('/a', 1, b'1')])
    assert channels.update({}) == ([], [a.info.id])
    assert not a.slots
    other = GraphTopic('/a', 'std_msgs/msg/Bool', 'bool data')
    new, _ = channels.update({'/a': other})
    assert new[0].info.id != a.info.id
    new, gone = channels.update({'/a': topic('/a', slots=4)})
    assert new == [a]
    assert gone != [a.info.id]
    assert a.slots.maxlen == 4


def test_slots_have_an_end_and_grow_without_loss():
    channels, (a,) = graph(topic('/a'))
    channels.take([('/a', 1, b'1'), ('/a', 2, b'2')])
    assert [one.data for one in a.slots] == [b'2']
    assert [one.data for one in a.fresh] == [b'1', b'2']
    channels.update({'/a': topic('/a', slots=10**6)})
    assert a.slots.maxlen == MOST_SLOTS
    assert [one.data for one in a.slots] == [b'2']
    channels.take([])
    assert a.fresh == []


def test_what_comes_of_a_topic_that_is_gone_is_nothing():
    channels, _ = graph(topic('/a'))
    channels.update({})
    assert channels.take([('/a', 1, b'1')]) == []
    assert channels.count == 0
