"""How ends of topics are named, and which of them are a person's tool."""

from __future__ import annotations

from types import SimpleNamespace as Some

import pytest

pytest.importorskip('rclpy')

from rclpy.node import NodeNameNonExistentError

from agv_motion.ros.graph_ends import MOST_NAMES, NAMELESS, full_name, is_tool, names


def end(name, namespace='/', gid=(1, 171)):
    return Some(node_name=name, node_namespace=namespace, endpoint_gid=gid)


class Graph:
    """Stands in for a node that knows the services of others; of some there are none any more."""

    def __init__(self, **services):
        self._services = services

    def get_service_names_and_types_by_node(self, name, namespace):
        if name not in self._services:
            raise NodeNameNonExistentError
        return [(f'{namespace.rstrip("/")}/{name}/{one}', []) for one in self._services[name]]


def test_nodes_are_named_with_their_namespace_and_twins_by_their_ends():
    assert full_name(end('wheels')) == '/wheels'
    assert full_name(end('wheels', '/oak')) == '/oak/wheels'
    assert names([end('a'), end(NAMELESS)]) == '/a, a node without a name'
    assert names([end('a'), end('a', gid=(0, 255))]) == '/a (GID 01.ab), /a (GID 00.ff)'


def test_of_many_nodes_a_few_are_named():
    many = [end(f'n{i}') for i in range(MOST_NAMES + 2)]
    assert names(many).endswith(f'/n{MOST_NAMES - 1} and 2 more')
    assert 'more' not in names(many[:MOST_NAMES])


@pytest.mark.parametrize(
    ('name', 'tool'),
    [('_ros2cli_7', True), ('player', True), ('wheels', False), ('gone', False), (NAMELESS, False)],
)
def test_hidden_nodes_and_players_of_bags_are_tools(name, tool):
    graph = Graph(player=['play_next', 'pause'], wheels=['set_pose'])
    assert is_tool(graph, end(name, '/oak')) is tool
