"""What nodes say to fixed wheels: no zero has a minus before it."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.wheel_commands import WheelCommands
from agv_motion.planar import Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.wheel_joints import WheelJoints


def test_wheels_that_stand_turn_neither_way():
    said = []
    graph = InProcessGraph(lambda publisher, _, data: said.append((publisher.kind, data)), 7)
    port = InProcessPort(graph, Place('node', '/oak', {}), str)
    commands = WheelCommands(port, WheelJoints(['left', 'right']), 'base_link')
    commands.send(Twist(-0.0, 0.0, -0.0), [-0.0, 0.5], 7)
    told = [codec(kind).decode(data) for kind, data in said]
    assert list(told[0].velocity) == [0.0, 0.5]
    assert '-0.0' not in str([*told, commands.twist])
