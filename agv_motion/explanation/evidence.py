"""What is known of one robot: the newest message of each topic and each node, with their ages.

Messages are anything with the fields of their ROS type: of rclpy, or out of a bag. Ages are by the
clock of whoever hears them, so that clocks of two machines are never compared.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.explanation.link import Level

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

TOPICS = {
    'cmd_vel': 'geometry_msgs/msg/TwistStamped',
    'driver': 'diagnostic_msgs/msg/DiagnosticStatus',
    'turrets/state': 'sensor_msgs/msg/JointState',
    'turrets/command': 'sensor_msgs/msg/JointState',
    'wheels/state': 'sensor_msgs/msg/JointState',
    'wheels/command': 'sensor_msgs/msg/JointState',
    'state': 'std_msgs/msg/String',
    'pose': 'geometry_msgs/msg/PoseWithCovarianceStamped',
    'odom': 'nav_msgs/msg/Odometry',
    'granier/sap_flow': 'geometry_msgs/msg/Vector3Stamped',
    'granier/valid': 'std_msgs/msg/Bool',
}
"""Topics that are listened to, relative to the robot, and their types; `/diagnostics` beside."""

LATCHED = frozenset({'driver', 'state', 'granier/valid'})

MOST_NODES = 60
"""of one robot that are kept"""

LONGEST = 300
"""characters of a text"""


class Report(NamedTuple):
    """What a node said last of itself."""

    level: Level
    message: str
    values: Mapping[str, str]
    at: float
    """[s] when it came"""

    def number(self, key: str) -> float | None:
        """Return a value as a number; None if it is none, or none is told."""
        try:
            number = float(self.values[key])
        except (KeyError, ValueError):
            return None
        return number if isfinite(number) else None


class Evidence:
    """The newest of one robot."""

    def __init__(self, namespace: str = '/') -> None:
        """Know nothing of the robot in ``namespace``, such as ``/oak``."""
        self.namespace = '/' + namespace.strip('/')
        self.nodes: dict[str, Report] = {}
        """by name without the namespace"""
        self.commanders: tuple[str, ...] | None = None
        """nodes that publish `cmd_vel`; None: nobody knows"""
        self._newest: dict[str, tuple[Any, float]] = {}

    def receive(self, topic: str, message: Any, now: float) -> None:
        """Take a message of a topic of the robot, or of ``/diagnostics``, at ``now`` [s]."""
        if topic == '/diagnostics':
            for status in message.status:
                self._receive_report(status, now)
        else:
            self._newest[topic] = message, now

    def message(self, topic: str) -> Any:
        """Return the newest message of a topic; None without one."""
        return self._newest.get(topic, (None, 0.0))[0]

    def age(self, topic: str, now: float) -> float | None:
        """Return for how long a topic has been silent [s]; None if it never spoke."""
        if topic not in self._newest:
            return None
        return max(now - self._newest[topic][1], 0.0)

    def first(self, names: Iterable[str]) -> tuple[str, Report] | None:
        """Return the first of some nodes that was ever heard."""
        return next(((name, self.nodes[name]) for name in names if name in self.nodes), None)

    @property
    def known(self) -> bool:
        """Whether anything was heard of the robot."""
        return bool(self.nodes or self._newest)

    def _receive_report(self, status: Any, now: float) -> None:
        namespace, _, name = str(status.name).rpartition('/')
        if '/' + namespace.strip('/') != self.namespace:
            return
        if name in self.nodes or len(self.nodes) < MOST_NODES:
            self.nodes[name] = report_of(status, now)


def report_of(status: Any, now: float) -> Report:
    """Return a diagnostic_msgs/DiagnosticStatus that came at ``now`` [s]."""
    level = status.level
    number = level[0] if isinstance(level, (bytes, bytearray)) and level else level
    known = isinstance(number, int) and 0 <= number <= Level.STALE
    values = {str(pair.key): str(pair.value)[:LONGEST] for pair in status.values}
    return Report(
        Level(number) if known else Level.STALE, str(status.message)[:LONGEST], values, now
    )
