"""Whole robots with their simulators on a graph of this process, spun by a thread of their own."""

from __future__ import annotations

import threading
from contextlib import contextmanager
from functools import partial

import pytest

rclpy = pytest.importorskip('rclpy')

from agv_motion.demo.configured import configured_node
from agv_motion.reprocess.recorded import node_class
from agv_motion.ros.robot_graphs import ROBOTS
from agv_motion.ros.run import spin, start

PATIENT = {
    'ghost_trajectory': ('report_after', 'stop_after', 'max_age'),
    'route_follower': ('report_after', 'stop_after', 'max_age'),
    'sequence': ('report_after', 'stop_after', 'max_age'),
    'differential_kinematics': ('report_after', 'stop_after', 'max_age'),
    'omni_kinematics': ('report_after', 'stop_after', 'max_age'),
}
"""Limits of inputs that are wide here [s]: the machine may be busy with something else"""
WIDE = 20.0


SWIFT = {
    'differential_kinematics': {
        'max_wheel_speed': 3.0, 'max_wheel_acceleration': 9.0, 'max_wheel_deceleration': 18.0,
    },
    'ghost_trajectory': {
        'rate': 20.0, 'cruising_speed': 1.0, 'speed_ramps': 2.0, 'follow__ghost__wheel_speed': 2.5,
        'follow__ghost__linear_speed': 2.5, 'follow__ghost__lateral_acceleration': 2.0,
        'follow__ghost__turn_rate': 5.0, 'follow__ghost__turn_acceleration': 9.0,
    },
    'differential_simulator': {'rate': 20.0, 'fixes__rate': 20.0},
}  # fmt: skip
"""Of a differential drive that is soon there, told as often as drives it there, not as is usual"""
NO_PICTURES = 'robot_model', 'scene', 'why'
"""Nodes that no client hears"""


@pytest.fixture(scope='session')
def slim(spun):
    """Return what lets a robot live for a while without what clients do not hear."""
    return partial(spun, without=NO_PICTURES)


@pytest.fixture(scope='session')
def swift(slim):
    """Return what lets a swift differential robot live for a while: it is soon there."""
    return lambda: slim('differential', 4.0, **SWIFT)


@pytest.fixture(scope='session')
def spun():
    """Return what lets a robot live for a while."""
    return _spun


@contextmanager
def _spun(robot, factor, *, without=(), **changes):
    """Let a robot as its launch file starts it live for a while; yield its nodes by name."""
    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    ended, nodes = threading.Event(), {}
    for one in ROBOTS[robot].nodes:
        if one.name in without or one.condition == 'nav2':
            continue
        kind, common = node_class(one.name), {}
        if one.name.endswith('simulator'):
            common = {'time_factor': factor}
        else:
            common = {'use_sim_time': True}
        common |= dict.fromkeys(PATIENT.get(one.name, ()), WIDE) | changes.get(one.name, {})
        remappings = [w for a, b in one.remappings
                      for w in ('-r', f'{a}:={b.replace("{pose}", "fix")}')]  # fmt: skip
        nodes[one.name] = configured_node(
            kind, f'{robot}.yaml', common, context=context,
            cli_args=['--ros-args', *remappings],
        )  # fmt: skip
    for node in nodes.values():
        start(node)
    thread = threading.Thread(
        target=spin, args=(list(nodes.values()), ended.is_set, 'events', context)
    )
    thread.start()
    try:
        yield nodes
    finally:
        ended.set()
        thread.join()
        for node in nodes.values():
            node.destroy_node()
        rclpy.shutdown(context=context)
