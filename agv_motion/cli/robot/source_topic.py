"""Where a command that drives has to speak: to the arbiter of the robot, or to its wheels."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import rclpy

if TYPE_CHECKING:
    from agv_motion.arbitration.source import TwistSource

PATIENCE = 2.0
"""[s] in which somebody who listens to the robot's twists should be found."""

LINGER = 0.5
"""[s] for which an arbiter is looked for where wheels were found."""


def arguments_for(source: TwistSource, name: str) -> list[str]:
    """Return arguments of ROS for a node that drives as ``source``; none without an arbiter.

    Args:
        source: As what it drives.
        name: Under which to look at the graph; hidden.

    """
    node = rclpy.create_node(name, start_parameter_services=False, enable_rosout=False)
    try:
        topic = str(node.resolve_topic_name('cmd_vel'))
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if node.count_subscribers(f'{topic}/{source.value}'):
                return ['--ros-args', '-r', f'cmd_vel:={topic}/{source.value}']
            if node.count_subscribers(topic):
                end = min(end, time.monotonic() + LINGER)
            rclpy.spin_once(node, timeout_sec=0.05)
        return []
    finally:
        node.destroy_node()
