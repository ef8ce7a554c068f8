"""A participant says of what it consists, and that is what a node of it has opened."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.cli.graph.discovery import unfinished
from agv_motion.cli.graph.participant_entities import ParticipantEntities, entities
from agv_motion.cli.graph.participants import GRAPH_TOPIC, ends_of
from agv_motion.errors import SignalError

gids = st.lists(st.binary(min_size=16, max_size=16), max_size=4)
nodes = st.lists(st.tuples(st.text('abz_', min_size=1), st.text('/oak'), gids, gids), max_size=3)


@given(st.binary(min_size=16, max_size=16), nodes)
def test_the_words_of_a_participant_are_read_as_they_are_written(gid, nodes):
    messages = pytest.importorskip('rmw_dds_common.msg')
    from rclpy.serialization import serialize_message

    def of(identities):
        return [messages.Gid(data=list(one)) for one in identities]

    message = messages.ParticipantEntitiesInfo(gid=messages.Gid(data=list(gid)))
    for name, space, reads, writes in nodes:
        node = messages.NodeEntitiesInfo(node_name=name, node_namespace=space)
        node.reader_gid_seq, node.writer_gid_seq = of(reads), of(writes)
        message.node_entities_info_seq.append(node)
    expected = {(one, name) for name, _, *both in nodes for ends in both for one in ends}
    assert entities(serialize_message(message)) == (gid[:12], expected)


@given(st.binary(max_size=80))
def test_other_bytes_are_an_error_or_nothing(data):
    try:
        entities(data)
    except SignalError:
        return


def test_a_node_hears_what_it_and_others_have_opened(graph):
    from std_msgs.msg import Empty

    node, other = graph.node('listener'), graph.node('late')
    with ParticipantEntities(node) as topic:
        heard = {}

        def knows(name):
            heard['told'], heard['ends'] = topic.told(), ends_of(node)
            return any(one[0] == f'rt/{name}' for one in heard['ends']) and not unfinished(
                heard['ends'], heard['told']
            )

        for name in ('first', 'second'):
            other.create_subscription(Empty, name, lambda _: None, 1)
            graph.spin_until(lambda name=name: knows(name))
            told = {one for ends in heard['told'].values() for one in ends}
            assert {
                (identity, whose)
                for topic, identity, _, whose in heard['ends']
                if topic != GRAPH_TOPIC
            } <= told
            (end,) = (one for one in heard['ends'] if one[0] == f'rt/{name}')
            assert unfinished(heard['ends'] - {end}, heard['told']) == {end[1][:12]}


def test_without_dds_nothing_is_told(graph, monkeypatch):
    from agv_motion.cli.graph import participant_entities

    monkeypatch.setattr(participant_entities, 'TYPE_SUPPORT', 'not_there')
    with ParticipantEntities(graph.node('deaf')) as topic:
        assert topic.told() is None
