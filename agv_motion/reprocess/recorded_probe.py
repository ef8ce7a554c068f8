"""The probe node on a recording: it takes the readings that were recorded."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Temperature, TimeReference

from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.probe.environment import Environment
from agv_motion.probe.sources.recorded import RecordedSource
from agv_motion.ros.messages import seconds_of
from agv_motion.ros.qos import SENSOR

if TYPE_CHECKING:
    from agv_motion.nodes.granier_probe import GranierProbeParameters
    from agv_motion.ros.port import Port


class RecordedProbe(GranierProbe):
    """The probe node on its recorded readings; its source is asked only for what came before."""

    def __init__(self, port: Port, parameters: GranierProbeParameters) -> None:
        """Open as live, then listen to the recording in place of the source."""
        recorded = RecordedSource(parameters.open_source(), parameters.probes())
        super().__init__(port, parameters, recorded)
        if parameters.probe.needs_environment:
            port.listen(Vector3Stamped, 'granier/environment', partial(_take_air, recorded), SENSOR)
        if parameters.has_logger:
            port.listen(TimeReference, 'granier/logger_time', partial(_take_time, recorded), SENSOR)
        for i in range(parameters.probes()):
            port.listen(
                Temperature, f'granier/probe_{i + 1}/temperature_difference',
                partial(_take, recorded, i), SENSOR,
            )  # fmt: skip


def _take_air(recorded: RecordedSource, message: Vector3Stamped) -> None:
    air = Environment(message.vector.x, message.vector.y)
    recorded.take_environment(seconds_of(message.header.stamp), air)


def _take_time(recorded: RecordedSource, message: TimeReference) -> None:
    recorded.take_time(seconds_of(message.header.stamp), seconds_of(message.time_ref))


def _take(recorded: RecordedSource, probe: int, message: Temperature) -> None:
    recorded.take(probe, seconds_of(message.header.stamp), message.temperature)
