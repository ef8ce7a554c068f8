"""Which topics the page knows, and whose they are: a namespace is a robot."""

from __future__ import annotations

import re

POSE, JOINTS, TEXT = (
    'geometry_msgs/msg/PoseWithCovarianceStamped', 'sensor_msgs/msg/JointState',
    'std_msgs/msg/String',
)  # fmt: skip
TOPICS = {
    'pose': POSE,
    'odom': 'nav_msgs/msg/Odometry',
    'turrets/state': JOINTS,
    'turrets/command': JOINTS,
    'turrets/limiter': TEXT,
    'wheels/state': JOINTS,
    'wheels/command': JOINTS,
    'cmd_vel/limited': 'geometry_msgs/msg/TwistStamped',
    'goal': 'geometry_msgs/msg/PoseStamped',
    'path': 'nav_msgs/msg/Path',
    'ghost/path': 'nav_msgs/msg/Path',
    'route/path': 'nav_msgs/msg/Path',
    'sequence/path': 'nav_msgs/msg/Path',
    'state': TEXT,
    'ghost/state': TEXT,
    'route/state': TEXT,
    'sequence/state': TEXT,
    'sequence/status': 'diagnostic_msgs/msg/DiagnosticStatus',
    'driver': 'diagnostic_msgs/msg/DiagnosticStatus',
    'standstill': 'std_msgs/msg/Bool',
    'why': 'diagnostic_msgs/msg/DiagnosticArray',
    'granier/sap_flow': 'geometry_msgs/msg/Vector3Stamped',
    'granier/valid': 'std_msgs/msg/Bool',
    'granier/water_use_today': 'geometry_msgs/msg/Vector3Stamped',
    **{f'granier/probe_{i}/temperature_difference': 'sensor_msgs/msg/Temperature'
       for i in range(1, 10)},
    'memory/sap_flow': 'nav_msgs/msg/OccupancyGrid',
    'memory/last_visit': 'nav_msgs/msg/OccupancyGrid',
    'zone': TEXT,
    'sunlight': 'sensor_msgs/msg/Illuminance',
}  # fmt: skip
"""Topics of one robot, relative to its namespace, each with the type that it must have."""

SHARED = {
    'clock': 'rosgraph_msgs/msg/Clock',
    'diagnostics': 'diagnostic_msgs/msg/DiagnosticArray',
    'reservations': 'visualization_msgs/msg/MarkerArray',
}
"""Topics that all robots share, in the root namespace."""

FIELDS = {
    POSE: ('header', 'pose'),
    JOINTS: ('name', 'position', 'velocity'),
    TEXT: ('data',),
    'nav_msgs/msg/Odometry': ('twist',),
    'geometry_msgs/msg/TwistStamped': ('twist',),
    'geometry_msgs/msg/PoseStamped': ('pose',),
    'nav_msgs/msg/Path': ('poses',),
    'diagnostic_msgs/msg/DiagnosticStatus': ('level', 'name', 'message', 'values'),
    'std_msgs/msg/Bool': ('data',),
    'diagnostic_msgs/msg/DiagnosticArray': ('status',),
    'geometry_msgs/msg/Vector3Stamped': ('header', 'vector'),
    'sensor_msgs/msg/Temperature': ('temperature',),
    'nav_msgs/msg/OccupancyGrid': ('info', 'data'),
    'sensor_msgs/msg/Illuminance': ('header', 'illuminance'),
    'rosgraph_msgs/msg/Clock': ('clock',),
    'visualization_msgs/msg/MarkerArray': ('markers',),
}
"""What a message of each type has at least; one that has not is none."""

SIGNS = ('driver', 'turrets/state', 'turrets/command', 'wheels/state', 'wheels/command', 'odom')
"""Who speaks on one of these is a robot."""

ALONE = 'robot'
"""How a robot without a namespace is called."""
MOST_ROBOTS = 10

_NAMESPACE = re.compile(r'(/[A-Za-z_][A-Za-z0-9_]{0,63}){0,4}')
_SUFFIXES = sorted(TOPICS, key=len, reverse=True)


def robot_of(namespace: str) -> str:
    """Return how the robot in a namespace is called: ``/oak`` is oak, ``/yard/oak`` is yard.oak.

    What has no namespace is `ALONE`; one that has just that name is told apart by a dot.

    Returns:
        The name; empty if the namespace is none that ROS allows.

    """
    if namespace in {'', '/'}:
        return ALONE
    if not _NAMESPACE.fullmatch(namespace):
        return ''
    name = namespace[1:].replace('/', '.')
    return f'.{name}' if name == ALONE else name


def namespace_of(robot: str) -> str:
    """Return the namespace of a robot: the inverse of :func:`robot_of`."""
    return '' if robot == ALONE else '/' + robot.lstrip('.').replace('.', '/')


def split(topic: str) -> tuple[str, str] | None:
    """Return robot and relative name of a full topic; None if the page does not know it.

    What all robots share has the robot ``''``.
    """
    if topic[1:] in SHARED:
        return '', topic[1:]
    for suffix in _SUFFIXES:
        if topic.endswith('/' + suffix):
            robot = robot_of(topic[: -len(suffix) - 1])
            return (robot, suffix) if robot else None
    return None


def type_of(relative: str) -> str:
    """Return the type that a topic must have; empty if the page does not know it."""
    return TOPICS.get(relative) or SHARED.get(relative, '')
