"""Whether a robot does what a node says: an arbiter may obey another, or stop it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticStatus

from agv_motion.arbitration.source import TwistSource
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from agv_motion.ros.port import Port

OLD = 3.0
"""[s] The arbiter tells once a second who drives; from one that has fallen silent nothing is known.
"""
SOURCES = frozenset(source.value for source in TwistSource)


class Obedience:
    """Listens to `driver`, on behalf of a node whose `cmd_vel` may be one of several."""

    def __init__(self, port: Port) -> None:
        """Open the topic; a node whose `cmd_vel` goes straight to the wheels is always obeyed."""
        self._port = port
        self._source = port.full_name('cmd_vel').rpartition('/')[2]
        self._driver = self._source
        self._told = 0.0
        if self._source in SOURCES:
            port.listen(DiagnosticStatus, 'driver', self._on_driver, LATCHED)

    @property
    def held(self) -> bool:
        """Whether the arbiter has said of late that it obeys another, or nobody."""
        others = self._driver != self._source
        return others and self._port.steady_seconds() - self._told <= OLD

    def _on_driver(self, message: Any) -> None:
        values = {each.key: each.value for each in message.values}
        self._driver = values.get('driver', self._source)
        self._told = self._port.steady_seconds()
