"""What a node tells of itself on ``/diagnostics``: the worst that is known, and all numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.qos import QoSProfile

from agv_motion.ros.diagnosis import ERROR, WARN, Diagnosis
from agv_motion.ros.ends import NO_EVENTS

if TYPE_CHECKING:
    from agv_motion.ros.complaints import Complaints
    from agv_motion.ros.graph_guard import GraphGuard
    from agv_motion.ros.node import ManagedNode


class Diagnostics:
    """Publishes how one node is, configured or not."""

    def __init__(self, node: ManagedNode[Any], graph: GraphGuard, complaints: Complaints) -> None:
        """Open the topic."""
        self._node, self._graph, self._complaints = node, graph, complaints
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
        node.stamp(report)
        self._publisher.publish(report)

    def _condition(self) -> Diagnosis:
        """Return what the node says of itself, or why it does not act."""
        node = self._node
        if node.active:
            try:
                return node.diagnose()
            except Exception as error:  # noqa: BLE001 - a defect
                node.stop_for('the diagnostics', error)
        if self._graph.rivals:
            return Diagnosis(ERROR, f'stopped: {self._graph.rivals}', {})
        if node.defect:
            return Diagnosis(ERROR, f'stopped by {node.defect}', {})
        return Diagnosis(WARN, 'not active', {})

    def _judged(self, found: Diagnosis) -> Diagnosis:
        """Return what was ``found`` beside what graph, clock and refusals tell."""
        complaints, fault = self._complaints, self._node.clock.fault
        values = found.values | self._graph.values()
        if complaints.count:
            values |= {'refused inputs': str(complaints.count), 'last': complaints.last}
        found = found._replace(values=values)
        for mismatch in self._graph.faults()[:1]:
            found = found.worsened(WARN, mismatch)
        if fault:
            found = Diagnosis(ERROR, f'{fault}: standing still', values)
        if complaints.is_recent():
            found = found.worsened(WARN, f'refused: {complaints.last}')
        return found
