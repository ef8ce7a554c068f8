"""What `granier_probe` tells of each sample: as it was read, the air, the time of the logger."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING

from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Temperature, TimeReference

from agv_motion.ros.messages import stamp_of
from agv_motion.ros.qos import SENSOR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.sources.source import ProbeSample
    from agv_motion.ros.port import Port

LAST_STAMP = 2**31
"""[s] since 1970, which no message can tell"""


class ProbeReadings:
    """`granier/probe_i/temperature_difference`, `granier/environment`, `granier/logger_time`."""

    def __init__(self, port: Port, frames: Sequence[str], *, air: bool, logger: bool) -> None:
        """Open the topics.

        Args:
            port: Of the node.
            frames: Of the probes.
            air: Whether zero flow is known by the air.
            logger: Whether a logger has its own time, which may be of a year ago.

        """
        self._port, self._frames = port, frames
        self._probes = [
            port.publisher(Temperature, f'granier/probe_{i + 1}/temperature_difference', SENSOR)
            for i in range(len(frames))
        ]
        self._air = port.publisher(Vector3Stamped, 'granier/environment', SENSOR) if air else None
        self._time = (
            port.publisher(TimeReference, 'granier/logger_time', SENSOR) if logger else None
        )

    def publish(self, sample: ProbeSample) -> None:
        """Tell one sample; time and air come before the readings, for who reads a recording."""
        reference = TimeReference(source='granier')
        self._port.stamp(reference)
        stamp = reference.header.stamp
        if self._time is not None and sample.time < LAST_STAMP:
            microseconds = round(sample.time * 1e6)  # a float of seconds holds no more of 2015
            reference.time_ref = stamp_of(1000 * microseconds)
            self._time.publish(reference)
        if self._air is not None:
            air = Vector3Stamped(header=reference.header)
            air.vector.x, air.vector.y = sample.environment
            self._air.publish(air)
        for value, publisher, frame in zip(sample.values, self._probes, self._frames, strict=True):
            if not isnan(value):
                message = Temperature(temperature=value)
                message.header.stamp, message.header.frame_id = stamp, frame
                publisher.publish(message)
