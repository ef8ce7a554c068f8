"""What `wheel_kinematics` says to the turrets: no zero has a minus before it."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.steering_parameters import WheelKinematicsParameters
from agv_motion.nodes.turret_commands import TurretCommands
from agv_motion.planar import Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.messages import TurretJoints


def test_turrets_that_point_ahead_and_stand_turn_neither_way():
    said = []
    graph = InProcessGraph(lambda publisher, _, data: said.append((publisher.kind, data)), 7)
    port = InProcessPort(graph, Place('node', '/oak', {}), str)
    given = WheelKinematicsParameters()
    setpoints = SimpleNamespace(
        angles=[-0.0, 0.5, -0.0], speeds=[-0.0, -0.0, 0.1],
        twist=lambda _: Twist(-0.0, 0.0, -0.0),
    )  # fmt: skip
    driving = SimpleNamespace(
        setpoints=setpoints, share=lambda: 1.0, planner=SimpleNamespace(turrets=None)
    )
    TurretCommands(port, given, TurretJoints(3)).send(driving, 7)
    told = [codec(kind).decode(data) for kind, data in said]
    assert list(told[0].position) == [0.0, 0.5, 0.0, 0.0, 0.0, 0.0]
    assert told[0].velocity[5] == pytest.approx(0.1 / given.wheel_radius)
    assert '-0.0' not in str(told)
