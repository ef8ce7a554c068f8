"""What a node tells of itself on ``/diagnostics``: the worst that is known, and all numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.qos import QoSProfile

from agv_motion.clock_watch import WAITING
from agv_motion.ros.diagnosis import ERROR, WARN, Diagnosis
from agv_motion.ros.ends import NO_EVENTS
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.ros.live_port import LivePort


class Diagnostics:
    """Publishes how one node is, configured or not."""

    def __init__(self, port: LivePort, condition: Callable[[], Diagnosis]) -> None:
        """Open the topic.

        Args:
            port: Of the node.
            condition: Returns what the node says of itself, or why it does not act.

        """
        self._port, self._condition = port, condition
        self._publisher = port.node.create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=10), event_callbacks=NO_EVENTS
        )

    def publish(self) -> None:
        """Tell how the node is now."""
        found, port = self._judged(self._condition()), self._port
        name = f'{port.namespace}/{port.name}'.replace('//', '/')
        values = [KeyValue(key=key, value=value) for key, value in found.values.items()]
        status = DiagnosticStatus(
            level=found.level, name=name, message=found.message, hardware_id=name, values=values
        )
        report = DiagnosticArray(status=[status])
        if found.stamp is None:
            port.stamp(report)
        else:
            report.header.stamp = stamp_of(found.stamp)
        self._publisher.publish(report)

    def _judged(self, found: Diagnosis) -> Diagnosis:
        """Return what was ``found`` beside what graph, clock and refusals tell."""
        complaints, graph = self._port.complaints, self._port.graph
        fault = self._port.clock.fault
        values = found.values | graph.values()
        if complaints.count:
            values |= {'refused inputs': str(complaints.count), 'last': complaints.last}
        found = found._replace(values=values)
        for mismatch in graph.faults()[:1]:
            found = found.worsened(mismatch)
        if fault:
            values = found.values | {'clock fault': fault}
            waits = fault in WAITING
            level, doing = (WARN, 'waiting for it') if waits else (ERROR, 'standing still')
            found = Diagnosis(level, f'{fault}: {doing}', values, found.stamp)
        if complaints.is_recent():
            found = found.worsened(f'refused: {complaints.last}')
        return found
