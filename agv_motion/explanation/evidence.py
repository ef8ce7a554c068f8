"""What is known of one robot: what each of its nodes said last, and who drives, with their ages.

Messages are anything with the fields of their ROS type: of rclpy, or out of a bag. Ages are by the
clock of whoever hears them, so that clocks of two machines are never compared.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.explanation.link import Level

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

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

    @property
    def clock_fault(self) -> str:
        """Why the node does not believe its clock; empty if it does."""
        return self.values.get('clock fault', '')

    def number(self, key: str) -> float | None:
        """Return a value as a number; None if it is none, or none is told."""
        try:
            number = float(self.values[key])
        except (KeyError, ValueError):
            return None
        return number if isfinite(number) else None


class Evidence:
    """The last words of one robot; all of `/diagnostics`, which tell what counts once a second."""

    def __init__(self, namespace: str = '/') -> None:
        """Know nothing of the robot in ``namespace``, such as ``/oak``."""
        self.namespace = '/' + namespace.strip('/')
        self.nodes: dict[str, Report] = {}
        """by name without the namespace"""
        self.driver: Report | None = None
        """what the arbiter said last on `driver`; None without one"""
        self.commanders: tuple[str, ...] = ()
        """nodes that publish `cmd_vel`, where somebody knows"""

    def receive(self, message: Any, now: float) -> None:
        """Take a message of ``/diagnostics`` that came at ``now`` [s]."""
        for status in message.status:
            namespace, _, name = str(status.name).rpartition('/')
            if '/' + namespace.strip('/') != self.namespace:
                continue
            if name in self.nodes or len(self.nodes) < MOST_NODES:
                self.nodes[name] = report_of(status, now)

    def receive_driver(self, message: Any, now: float) -> None:
        """Take a message of the topic `driver` of the robot."""
        self.driver = report_of(message, now)

    def first(self, names: Iterable[str]) -> tuple[str, Report] | None:
        """Return the first of some nodes that was ever heard."""
        return next(((name, self.nodes[name]) for name in names if name in self.nodes), None)


def report_of(status: Any, now: float) -> Report:
    """Return a diagnostic_msgs/DiagnosticStatus that came at ``now`` [s]."""
    level = status.level
    number = level[0] if isinstance(level, (bytes, bytearray)) and level else level
    known = isinstance(number, int) and 0 <= number <= Level.STALE
    values = {str(pair.key): str(pair.value)[:LONGEST] for pair in status.values}
    return Report(
        Level(number) if known else Level.STALE, str(status.message)[:LONGEST], values, now
    )
