"""What `granier_probe` tells of the water that a tree drinks: litres an hour, and of today."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import Vector3Stamped

from agv_motion.probe.water import WaterMeter
from agv_motion.ros.qos import SENSOR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.parameters import ProbeParameters
    from agv_motion.probe.probe import ProbeReading
    from agv_motion.probe.water import Litres, WaterParameters, WaterUse
    from agv_motion.ros.port import Port


class WaterReport:
    """`granier/water_use` [l/h] and `granier/water_use_today` [l]: value, low, high as x, y, z."""

    def __init__(
        self, port: Port, water: WaterParameters, probe: ProbeParameters, frame: str
    ) -> None:
        """Open the topics.

        Args:
            port: Of the node.
            water: The sapwood.
            probe: How the probes are read.
            frame: Of the robot.

        """
        self._port = port
        self._meter = WaterMeter(water, probe.calibration.chosen(), probe.solar_offset)
        self._message = Vector3Stamped()
        self._message.header.frame_id = frame
        self._rate = port.publisher(Vector3Stamped, 'granier/water_use', SENSOR)
        self._today = port.publisher(Vector3Stamped, 'granier/water_use_today', SENSOR)
        self._last: WaterUse | None = None

    def update(self, time: float, readings: Sequence[ProbeReading | None], *, tell: bool) -> None:
        """Add up, and tell what is known.

        Args:
            time: Of the readings [s since 1970].
            readings: Of all probes.
            tell: Whether to publish it; False for what was measured before the start.

        """
        self._last = self._meter.update(time, readings)
        if tell and self._last is not None:
            self._port.stamp(self._message)
            for publisher, litres in (
                (self._rate, self._last.rate),
                (self._today, self._last.day),
            ):
                vector = self._message.vector
                vector.x, vector.y, vector.z = litres
                publisher.publish(self._message)

    def values(self) -> dict[str, str]:
        """Return what is known, for programs that read the diagnostics."""
        if self._last is None:
            return {}
        return {
            'water use [l/h]': _told(self._last.rate),
            'water use today [l]': _told(self._last.day),
            'water use today known [h]': f'{self._last.known / 3600.0:.2f}',
        }


def _told(litres: Litres) -> str:
    return f'{litres.value:.3f} ({litres.low:.3f} to {litres.high:.3f})'
