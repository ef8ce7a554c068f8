"""What is heard of a robot, newest only."""

from __future__ import annotations

from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from rclpy.qos import QoSProfile
from std_msgs.msg import String

from agv_motion.client.drivers import DRIVERS, Driver
from agv_motion.errors import AgvMotionError
from agv_motion.planar import Twist
from agv_motion.ros.messages import pose_of, seconds_of
from agv_motion.ros.qos import LATCHED, SENSOR

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.client.link import Heard, ScriptLink
    from agv_motion.planar import Pose

REPORTS = QoSProfile(depth=50)
"""All nodes of all robots speak on one topic."""
FRESH = 3.0
"""[s] for which an explanation told once a second is believed"""


class RobotView:
    """The newest of each topic of one robot, and of each of its nodes."""

    def __init__(self, link: ScriptLink, news: Callable[[str, Heard], None]) -> None:
        """Listen.

        Args:
            link: To the graph.
            news: Called with the topic of each message.

        """
        self._heard: dict[str, Heard] = {}
        self._nodes: dict[str, Heard] = {}
        self._clocks: dict[str, float] = {}
        """what time it was in each node when it told how it is [s]"""
        self.poses_told = 0
        """Messages of its localization so far"""
        self._news, self._prefix = news, f'{link.node.get_namespace().rstrip("/")}/'
        for kind, topic, qos in (
            (Odometry, 'odom', SENSOR),
            (PoseWithCovarianceStamped, 'pose', SENSOR),
            (PoseWithCovarianceStamped, 'fix', SENSOR),
            (DiagnosticStatus, 'driver', LATCHED),
            (DiagnosticArray, 'why', LATCHED),
            (PoseStamped, 'goal', LATCHED),
            *((String, driver.state, LATCHED) for driver in DRIVERS),
            *((Path, driver.path, LATCHED) for driver in DRIVERS),
        ):
            link.hear(kind, topic, qos, partial(self._take, topic))
        link.hear(DiagnosticArray, '/diagnostics', REPORTS, self._take_report)

    @property
    def is_there(self) -> bool:
        """Whether anything was heard of the robot."""
        return bool(self._nodes) and ('odom' in self._heard or self._arbiter)

    def state(self, driver: Driver) -> str:
        """Return what a node says to be doing; empty as long as it has not."""
        heard = self._heard.get(driver.state)
        return '' if heard is None else str(heard.message.data)

    @property
    def stop(self) -> str:
        """Why a STOP holds, as the arbiter tells; empty if none does."""
        return _values(self._heard['driver'].message).get('stop', '') if self._arbiter else ''

    @property
    def odometry(self) -> Pose | None:
        """Where the wheels have carried the robot; None as long as they have not told."""
        return self._pose('odom')

    @property
    def twist(self) -> Twist | None:
        """How fast the wheels carry it; None as long as they have not told."""
        heard = self._heard.get('odom')
        if heard is None:
            return None
        linear, angular = heard.message.twist.twist.linear, heard.message.twist.twist.angular
        return Twist(linear.x, linear.y, angular.z)

    def pose_in(self, frame: str) -> Pose | None:
        """Return where the robot is in a frame, as the newest that tells it says."""
        known = [
            (heard.at, topic)
            for topic in ('pose', 'odom', 'fix')
            if (heard := self._heard.get(topic)) is not None
            and heard.message.header.frame_id.lstrip('/') == frame.lstrip('/')
        ]
        told = [topic for _, topic in known]
        return self._pose('pose' if 'pose' in told else max(known)[1]) if known else None

    def refusals(self, node: str) -> tuple[int, str]:
        """Return how often a node has refused something, and why the last time."""
        values = self._report(node)
        return int(values.get('refused inputs', '0')), values.get('last', '')

    def clock_of(self, node: str) -> float | None:
        """Return what time it was in a node when it last told how it is [s]; None: it has not."""
        return self._clocks.get(node)

    def silence(self, node: str, now: float) -> float:
        """Return for how long a node has not told how it is [s]; infinite if it never has."""
        heard = self._nodes.get(node)
        return inf if heard is None else now - heard.at

    def odometry_silence(self, now: float) -> float:
        """Return for how long the wheels have not told where they are [s]."""
        heard = self._heard.get('odom')
        return inf if heard is None else now - heard.at

    def why(self, now: float) -> str:
        """Return why the robot does what it does, in a sentence; empty if nobody tells."""
        if self.stop:
            return str(self._heard['driver'].message.message)
        heard = self._heard.get('why')
        if heard is not None and heard.message.status and now - heard.at < FRESH:
            return str(heard.message.status[0].message)
        return str(self._heard['driver'].message.message) if self._arbiter else ''

    @property
    def _arbiter(self) -> bool:
        return 'driver' in self._heard

    def _pose(self, topic: str) -> Pose | None:
        heard = self._heard.get(topic)
        if heard is None:
            return None
        try:
            return pose_of(heard.message.pose.pose)
        except AgvMotionError:
            return None

    def _report(self, node: str) -> dict[str, str]:
        heard = self._nodes.get(node)
        return {} if heard is None else _values(heard.message)

    def _take(self, topic: str, heard: Heard) -> None:
        self._heard[topic] = heard
        self.poses_told += topic == 'pose'
        self._news(topic, heard)

    def _take_report(self, heard: Heard) -> None:
        for status in heard.message.status:
            name = status.name.removeprefix(self._prefix)
            if name != status.name and '/' not in name:
                self._nodes[name] = heard._replace(message=status)
                self._clocks[name] = seconds_of(heard.message.header.stamp)


def _values(status: Any) -> dict[str, str]:
    return {pair.key: pair.value for pair in status.values}
