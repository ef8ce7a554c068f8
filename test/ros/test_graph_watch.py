"""What a node finds on its topics by the names that they have after remapping."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from std_msgs.msg import String

from agv_motion.ros.graph_watch import GraphWatch
from agv_motion.ros.qos import COMMAND


def test_a_remapped_topic_is_looked_at_where_it_is(graph):
    node = rclpy.create_node(
        'watcher', namespace='/oak', context=graph.context,
        cli_args=['--ros-args', '-r', 'in:=there', '-r', 'out:=/motors'],
    )  # fmt: skip
    others = [rclpy.create_node(name, context=graph.context) for name in ('one', 'two')]
    watch = GraphWatch(node)
    node.create_publisher(String, 'out', COMMAND)
    watch.add(String, 'in', COMMAND, publishes=False, sole=True)
    watch.add(String, 'out', COMMAND, publishes=True, sole=True)
    watch.needed.append('in')
    assert watch.missing() == 'there'
    for other in others:
        other.create_publisher(String, '/oak/there', COMMAND)
    others[0].create_publisher(String, '/motors', COMMAND)
    graph.spin_until(lambda: watch.look() and watch.crowds())
    assert '/two' in watch.crowds()['in']
    assert '/oak/watcher' in watch.look()
    assert '/one' in watch.look()
    assert watch.missing() == ''
    assert watch.introduction() == 'active: there -> /motors'
    for each in (node, *others):
        each.destroy_node()
