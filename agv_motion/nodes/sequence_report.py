"""What the node `sequence` tells of a sequence: its way, its status and how far it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from nav_msgs.msg import Path
from std_msgs.msg import Float64

from agv_motion.ros.messages import fill_path
from agv_motion.ros.qos import LATCHED, SENSOR

if TYPE_CHECKING:
    from agv_motion.ros.port import Port
    from agv_motion.sequence.prediction import Predicted
    from agv_motion.sequence.runner import SequenceRunner

TOLD_EVERY = 0.2
"""[s] between two words on progress."""


class SequenceReport:
    """Publishes `sequence/status`, `sequence/progress` and `sequence/path`."""

    def __init__(self, port: Port) -> None:
        """Open the topics."""
        self._port = port
        self._untold = 0.0
        self._status = port.publisher(DiagnosticStatus, 'sequence/status', LATCHED)
        self._progress = port.publisher(Float64, 'sequence/progress', SENSOR)
        self._path = port.publisher(Path, 'sequence/path', LATCHED)

    def show(self, predicted: list[Predicted], frame: str) -> None:
        """Tell the way that a sequence is to go, in ``frame``."""
        message = Path()
        self._port.stamp(message)
        message.header.frame_id = frame
        fill_path(message, [pose for each in predicted for pose in each.poses])
        self._path.publish(message)

    def is_due(self, dt: float) -> bool:
        """Let ``dt`` [s] pass; return whether progress is to be told again."""
        self._untold += dt
        return self._untold >= TOLD_EVERY

    def publish(self, runner: SequenceRunner, level: bytes, told: str, share: float) -> None:
        """Tell the status.

        Args:
            runner: Of the sequence.
            level: Of the diagnostics.
            told: What it does, in words.
            share: How much of it is behind, in [0, 1].

        """
        self._untold = 0.0
        self._progress.publish(Float64(data=share))
        status = runner.status
        pairs = {
            'sequence': runner.sequence.name,
            'state': status.state.value,
            'action': runner.present.name,
            'number': f'{status.number + 1}',
            'of': f'{len(runner.sequence.steps)}',
            'attempt': f'{status.attempt}',
            'elapsed [s]': f'{status.elapsed:.1f}',
            'timeout [s]': f'{runner.present.timeout:g}',
            'action done': f'{status.progress:.3f}',
            'sequence done': f'{share:.3f}',
            'last failure': status.reason,
        }
        self._status.publish(
            DiagnosticStatus(
                level=level,
                name=self._port.name,
                message=told,
                values=[KeyValue(key=key, value=value) for key, value in pairs.items()],
            )
        )
