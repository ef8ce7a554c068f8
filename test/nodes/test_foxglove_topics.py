"""Which topics of a graph are served, and why others are not: without a graph."""

from __future__ import annotations

from types import SimpleNamespace as Some

import pytest

pytest.importorskip('rclpy')

from agv_motion.dashboard.foxglove.transforms import HOLD, DerivedTransforms
from agv_motion.nodes.foxglove_topics import IN_TURN, ServedTopics
from agv_motion.ros.qos import COMMAND, LATCHED

TEXT, NUMBER = 'std_msgs/msg/String', 'std_msgs/msg/Float64'


class Graph:
    """Stands in for a node: knows who publishes what, and counts how often it is asked."""

    def __init__(self, **topics):
        self.topics, self.asked = {f'/{name}': ends for name, ends in topics.items()}, []

    def names(self):
        return [(name, sorted({one.topic_type for one in ends}) or [TEXT])
                for name, ends in self.topics.items()]  # fmt: skip

    def count_publishers(self, name):
        return len(self.topics[name])

    def get_publishers_info_by_topic(self, name):
        self.asked.append(name)
        return self.topics[name]


def end(kind=TEXT, qos=COMMAND):
    return Some(topic_type=kind, qos_profile=qos)


def served(graph):
    topics = ServedTopics(graph, DerivedTransforms(HOLD))
    topics.look(graph.names())
    return topics


def test_one_type_that_is_installed_and_somebody_who_publishes_make_a_topic():
    graph = Graph(
        said=[end(), end()], kept=[end(qos=LATCHED)], silent=[], two=[end(), end(NUMBER)],
        strange=[end('no_such/msg/Thing')],
    )  # fmt: skip
    topics = served(graph)
    assert topics.found.keys() == {'/said', '/kept'}
    assert (topics.found['/said'].slots, topics.found['/said'].latched) == (2, False)
    assert topics.found['/kept'].latched
    assert topics.complaints.keys() == {'/two', '/strange'}
    assert topics.complaints['/two'].startswith(f'it has the types {NUMBER}, {TEXT}')
    assert topics.publishers('/said') == graph.topics['/said']


def test_what_has_not_changed_is_the_same_object_and_what_has_is_another():
    graph = Graph(said=[end()], two=[end(), end(NUMBER)])
    topics = served(graph)
    found, complaints = topics.found, topics.complaints
    topics.look(graph.names())
    assert (topics.found, topics.complaints) == (found, complaints)
    assert topics.found is found
    assert topics.complaints is complaints
    graph.topics['/said'].append(end())
    graph.topics['/two'].pop()
    topics.look(graph.names())
    assert topics.found['/said'].slots == 2
    assert '/two' in topics.found
    assert topics.complaints == {}


def test_topics_are_asked_for_where_the_number_has_changed_and_a_few_in_turn():
    graph = Graph(**{f't{i}': [end()] for i in range(3 * IN_TURN)})
    topics = served(graph)
    asked = []
    for _ in range(3):
        graph.asked.clear()
        topics.look(graph.names())
        assert len(graph.asked) == IN_TURN
        asked += graph.asked
    assert sorted(asked) == sorted(graph.topics)


def test_transforms_are_offered_where_nobody_tells_them():
    graph = Graph(odom=[end('nav_msgs/msg/Odometry')])
    topics = served(graph)
    assert topics.derived.keys() == {'/tf', '/tf_static'}
    assert topics.derived.keys() < topics.found.keys()
