"""What a node tells of itself on ``/diagnostics``: the worst that is known, and all numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.qos import QoSProfile

from agv_motion.ros.diagnosis import ERROR, WARN, Diagnosis
from agv_motion.ros.ends import NO_EVENTS
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from agv_motion.ros.live_node import LiveNode


class Diagnostics:
    """Publishes how one node is, configured or not."""

    def __init__(self, node: LiveNode[Any]) -> None:
        """Open the topic."""
        self._node, self._graph, self._complaints = node, node.port.graph, node.port.complaints
        self._publisher = node.create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=10), event_callbacks=NO_EVENTS
        )

    def publish(self) -> None:
        """Tell how the node is now."""
        found, node = self._judged(self._condition()), self._node
        name = f'{node.get_namespace()}/{node.get_name()}'.replace('//', '/')
        values = [KeyValue(key=key, value=value) for key, value in found.values.items()]
        status = DiagnosticStatus(
            level=found.level, name=name, message=found.message, hardware_id=name, values=values
        )
        report = DiagnosticArray(status=[status])
        if found.stamp is None:
            node.port.stamp(report)
        else:
            report.header.stamp = stamp_of(found.stamp)
        self._publisher.publish(report)

    def _condition(self) -> Diagnosis:
        """Return what the node says of itself, or why it does not act."""
        node = self._node
        if node.active:
            try:
                return cast('Diagnosis', node.plain.diagnose())
            except Exception as error:  # noqa: BLE001 - a defect
                node.stop_for('the diagnostics', error)
        if self._graph.rivals:
            return Diagnosis(ERROR, f'stopped: {self._graph.rivals}', {})
        if node.defect:
            return Diagnosis(ERROR, f'stopped by {node.defect}', {})
        return Diagnosis(WARN, 'not active', {})

    def _judged(self, found: Diagnosis) -> Diagnosis:
        """Return what was ``found`` beside what graph, clock and refusals tell."""
        complaints, fault = self._complaints, self._node.port.clock.fault
        values = found.values | self._graph.values()
        if complaints.count:
            values |= {'refused inputs': str(complaints.count), 'last': complaints.last}
        found = found._replace(values=values)
        for mismatch in self._graph.faults()[:1]:
            found = found.worsened(WARN, mismatch)
        if fault:
            found = found._replace(level=ERROR, message=f'{fault}: standing still')
        if complaints.is_recent():
            found = found.worsened(WARN, f'refused: {complaints.last}')
        return found
