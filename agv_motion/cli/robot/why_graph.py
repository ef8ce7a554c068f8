"""What `agv why` hears of the robots on the graph: by itself, whether or not a node `why` runs."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any

from agv_motion.cli.graph.session import interface_class, spin
from agv_motion.errors import SourceError
from agv_motion.explanation.decision import DECIDERS
from agv_motion.explanation.evidence import Evidence
from agv_motion.explanation.explainer import Explainer
from agv_motion.explanation.wheels import DRIVERS
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from agv_motion.explanation.link import Chain

SIGNS = frozenset({*DRIVERS, *DECIDERS, 'granier_probe', 'localization', 'arbiter'})
"""Nodes that make a namespace a robot"""

ALONE = 'robot'
"""How a robot without a namespace is called"""

PATIENCE = 3.0
"""[s] in which each node has told how it is, three times over"""


class RobotEars:
    """Hears all robots that are asked about."""

    def __init__(self, node: Any, robot: str) -> None:
        """Listen.

        Args:
            node: Of rclpy, that knows the graph.
            robot: Name of one; empty: all.

        Raises:
            SourceError: There is none, or none of that name.

        """
        self._node, self._time = node, 0.0
        found = _robots(node)
        if not found:
            msg = (
                'no robot on the graph: start one (agv demo, ros2 launch ...), or compare '
                'ROS_DOMAIN_ID and ROS_AUTOMATIC_DISCOVERY_RANGE with its own'
            )
            raise SourceError(msg)
        names = {name_of(namespace): namespace for namespace in found}
        wanted = robot.strip('/')
        if wanted and wanted not in names:
            told = ', '.join(sorted(names))
            msg = f"no robot '{wanted}' on the graph{meant(wanted, list(names))}; there are: {told}"
            raise SourceError(msg)
        self._nodes = {name: found[names[name]] for name in names if not wanted or name == wanted}
        self.robots = {name: Evidence(names[name]) for name in sorted(self._nodes)}
        self._explainers = {name: Explainer() for name in self.robots}
        self._listen()

    def gather(self) -> None:
        """Listen until each node has told how it is, and a simulation its time; not for long."""
        end = time.monotonic() + PATIENCE

        def heard() -> bool:
            told = all(self._nodes[n] <= e.nodes.keys() for n, e in self.robots.items())
            return told and (self._time > 0.0 or not self._node.count_publishers('/clock'))

        spin(self._node, lambda: heard() or time.monotonic() > end)

    def chains(self) -> dict[str, Chain]:
        """Return the chain of each robot as it is now."""
        now, found = time.monotonic(), {}
        for name, evidence in self.robots.items():
            topic = f'{evidence.namespace.rstrip("/")}/cmd_vel'
            ends = self._node.get_publishers_info_by_topic(topic)
            evidence.commanders = tuple(sorted({end.node_name for end in ends}))
            found[name] = self._explainers[name].explain(evidence, now, self.time())
        return found

    def time(self) -> float:
        """Return the time of the robots, that of a simulation where there is one [s since 1970]."""
        return self._time or time.time()

    def time_zone(self, robot: str) -> str:
        """Return the time zone of a robot."""
        report = self.robots[robot].nodes.get('motion_generator')
        return 'UTC' if report is None else report.values.get('time zone', 'UTC')

    def _listen(self) -> None:
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        from agv_motion.ros.qos import LATCHED, SENSOR

        driver = interface_class('diagnostic_msgs/msg/DiagnosticStatus')
        for evidence in self.robots.values():
            topic = f'{evidence.namespace.rstrip("/")}/driver'
            take = partial(self._on_driver, evidence)
            self._node.create_subscription(driver, topic, take, LATCHED)
        reports = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
        kind = interface_class('diagnostic_msgs/msg/DiagnosticArray')
        self._node.create_subscription(kind, '/diagnostics', self._on_diagnostics, reports)
        kind = interface_class('rosgraph_msgs/msg/Clock')
        self._node.create_subscription(kind, '/clock', self._on_clock, SENSOR)

    def _on_driver(self, evidence: Evidence, message: Any) -> None:
        evidence.receive_driver(message, time.monotonic())

    def _on_diagnostics(self, message: Any) -> None:
        for evidence in self.robots.values():
            evidence.receive(message, time.monotonic())

    def _on_clock(self, message: Any) -> None:
        self._time = message.clock.sec + 1e-9 * message.clock.nanosec


def name_of(namespace: str) -> str:
    """Return how the robot in a namespace is called."""
    return namespace.strip('/') or ALONE


def _robots(node: Any) -> dict[str, set[str]]:
    """Return the nodes that make each namespace a robot."""
    found: dict[str, set[str]] = {}
    for name, namespace in node.get_node_names_and_namespaces():
        if name in SIGNS:
            found.setdefault(namespace, set()).add(name)
    return found
