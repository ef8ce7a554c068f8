"""Which nodes make up a robot: told once, for the launch files and for `agv up`.

What stands in braces in a value is an argument: ``'{state}/{namespace}/arbiter.json'``.
"""

from __future__ import annotations

import os
from typing import NamedTuple


class Argument(NamedTuple):
    """What may be said of a robot when it is started."""

    name: str
    default: str
    text: str


class GraphNode(NamedTuple):
    """One node of a robot."""

    name: str
    """of the node, and of its program"""
    values: tuple[tuple[str, str, type], ...] = ()
    """parameters beside those of the file: name, value, and type of the value"""
    remappings: tuple[tuple[str, str], ...] = ()
    condition: str = ''
    """argument that must be true for the node to be started; empty: it is in any case"""


class RobotGraph(NamedTuple):
    """All nodes of a robot."""

    arguments: tuple[Argument, ...]
    nodes: tuple[GraphNode, ...]


def _arguments(robot: str, simulated: str, *own: tuple[str, str, str]) -> tuple[Argument, ...]:
    """Return the arguments of a robot, its ``own`` ones after its configuration."""
    home = os.environ.get('HOME', '/var/lib')
    return tuple(
        Argument(*row)
        for row in (
            ('namespace', '', 'name of this robot: its topics are /NAME/cmd_vel and so on'),
            ('config', f'{robot}.yaml', 'YAML file with the parameters of all nodes'),
            *own,
            ('simulate', 'true', f'whether to simulate {simulated}'),
            ('use_sim_time', 'true', 'follow /clock: true with the simulator or a bag, else false'),
            ('time_factor', '1.0', 'simulated seconds per second'),
            ('clock', 'lead',
             'follow: another simulator tells the time, as of several robots all but one'),
            ('state', f'{home}/.local/state/agv_motion',
             'folder in which STOP and locks are kept over a restart'),
            ('nav2', 'false', "whether to offer Nav2's actions; needs nav2_msgs"),
            ('respawn', 'false', 'start a node again 2 s after it ended by itself'),
        )
    )  # fmt: skip


SIM_TIME = ('use_sim_time', '{use_sim_time}', bool)


def _node(name: str, *values: tuple[str, str, type], **remapped: str) -> GraphNode:
    """Return a node on the time of the robot."""
    return GraphNode(name, (SIM_TIME, *values), tuple(remapped.items()))


def _simulator(name: str) -> GraphNode:
    values = ('time_factor', '{time_factor}', float), ('clock', '{clock}', str)
    return GraphNode(name, values, condition='simulate')


NAV2 = GraphNode('nav2_actions', (SIM_TIME,), condition='nav2')
ARBITER = _node('arbiter', ('state_file', '{state}/{namespace}/arbiter.json', str))

GIVEN = (
    ('route', '', 'file of a route to follow at once; empty: one may come on the topic route'),
    ('sequence', '', 'file of a sequence of actions, for the service sequence/start'),
)
"""Arguments of the nodes below."""


def _drivers(**remapped: str) -> tuple[GraphNode, ...]:
    """Return what drives a robot to a goal, along a route and through a sequence, when asked."""
    return (
        _node('ghost_trajectory', cmd_vel='cmd_vel/page', **remapped),
        _node(
            'route_follower', ('route_file', '{route}', str), cmd_vel='cmd_vel/route', **remapped
        ),
        _node('sequence', ('file', '{sequence}', str), cmd_vel='cmd_vel/sequence', **remapped),
    )


ROBOTS = {
    'tree': RobotGraph(
        _arguments(
            'tree',
            'platform, localisation and sun',
            ('source', 'simulated', ('where the readings of the probes come from: simulated, csv, '
             'serial')),
        ),
        (
            _node('granier_probe', ('source', '{source}', str)),
            _node('motion_generator', cmd_vel='cmd_vel/agent'),
            ARBITER,
            _node('why'),
            _node('robot_model'),
            _node('scene'),
            _node('wheel_kinematics'),
            _node('localization'),
            NAV2,
            _simulator('simulator'),
        ),
    ),
    'omni': RobotGraph(
        _arguments('omni', 'the robot, its encoders, gyroscope and UWB', *GIVEN),
        (
            ARBITER,
            _node('why'),
            _node('robot_model'),
            _node('scene', path='ghost/path', state='ghost/state'),
            *_drivers(),
            _node('omni_kinematics'),
            _node('localization'),
            NAV2,
            _simulator('omni_simulator'),
        ),
    ),
    'differential': RobotGraph(
        _arguments(
            'differential',
            'the robot, its encoders and a camera over it',
            ('pose', 'fix', 'topic that tells where the robot is: fix, or pose of a localization'),
            *GIVEN,
        ),
        (
            _node('differential_kinematics'),
            ARBITER,
            _node('why'),
            _node('robot_model', pose='{pose}'),
            _node('scene', pose='{pose}', path='sequence/path', state='sequence/state'),
            *_drivers(pose='{pose}'),
            NAV2,
            _simulator('differential_simulator'),
        ),
    ),
}  # fmt: skip
"""By the name of the launch file; what drives to goals is silent until asked."""
