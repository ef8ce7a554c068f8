"""A tree for trials of the operator's page: simulator, arbiter, kinematics, localization; no agent.

    python launch_scripts/page/page_robot.py

Ends by a signal, or with the process that started it.
"""

from __future__ import annotations

import os

import rclpy
from rclpy.signals import SignalHandlerOptions

from agv_motion.demo.configured import configured_node
from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.run import spin, start
from agv_motion.ros.stop import Stop

CONFIG = 'tree.yaml'


def main():
    """Run the nodes until told to stop, or until nobody is left who could."""
    parent = os.getppid()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    stop = Stop()
    driven = [
        configured_node(kind, CONFIG, {'use_sim_time': True}, namespace='oak')
        for kind in (ArbiterNode, WheelKinematics, Localization)
    ]
    simulator = configured_node(
        Simulator, CONFIG, {'start_x': 5.0, 'start_y': 5.0}, namespace='oak')  # fmt: skip
    nodes = [*driven, simulator]
    for node in nodes:
        start(node)
    print('ready', flush=True)
    spin(nodes, lambda: stop.requested or os.getppid() != parent)
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
