"""Each robot of a demo has a node that says why, and both its words and its zone are recorded."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.demo.explained import robots, why_topics


def node(name, namespace):
    return SimpleNamespace(get_name=lambda: name, get_namespace=lambda: namespace)


def test_a_namespace_with_wheels_is_a_robot():
    nodes = [
        node('wheel_kinematics', '/oak'), node('motion_generator', '/oak'),
        node('wheel_kinematics', '/ash'), node('simulator', '/elm'), node('omni_kinematics', '/'),
    ]  # fmt: skip
    assert robots(nodes) == ['/', '/ash', '/oak']


def test_why_and_zone_of_each_are_recorded():
    topics = why_topics(['/', '/oak'])
    assert [topic.name for topic in topics] == ['why', 'zone', 'oak/why', 'oak/zone']
    assert all(topic.latched for topic in topics)
