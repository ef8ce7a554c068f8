"""The platform stands once in the shipped configuration, and every node takes of it what it has."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.demo.configured import configured
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.config import find_config
from agv_motion.ros.live_node import LiveNode

KINDS = {
    'granier_probe': GranierProbe, 'motion_generator': MotionGenerator,
    'wheel_kinematics': WheelKinematics, 'localization': Localization, 'simulator': Simulator,
}  # fmt: skip


@pytest.mark.parametrize('name', KINDS)
def test_no_node_of_the_tree_refuses_what_is_told_to_all(graph, name):
    file = str(find_config('tree.yaml'))
    node = graph.add(
        LiveNode(KINDS[name], context=graph.context, cli_args=['--ros-args', '--params-file', file])
    )
    assert node.declared.unknown == ()


def test_wheels_zone_and_traffic_have_the_same_outline(graph):
    change = {'platform_radius': 1.3}
    nodes = [
        graph.add(
            LiveNode(KINDS[name], context=graph.context, **configured('tree.yaml', name, change))
        )
        for name in ('motion_generator', 'wheel_kinematics', 'simulator')
    ]
    assert {node.parameters.rim for node in nodes} == {1.3}
    assert nodes[0].parameters.sharing().body == 1.3
