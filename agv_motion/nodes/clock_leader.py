"""What makes simulated time pass: one simulator tells it on /clock, and all others hear it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage

from agv_motion.ros.clock_guard import CLOCK_TOPIC
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.ros.port import Port

CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)

WATCH_PERIOD = 1.0
"""[s] between two looks at who else tells the time."""


class ClockLeader:
    """Publishes /clock, and finds out whether another node does so as well."""

    def __init__(self, port: Port, period: float, lead: Callable[[], None]) -> None:
        """Call ``lead`` each ``period`` [s], by the steady clock: it tells the next time."""
        self.rivals = ''
        """Which nodes tell the time together, in words; empty while this one is alone"""
        self._port = port
        self._publisher = port.publisher(ClockMessage, CLOCK_TOPIC, CLOCK)
        port.every(period, lead, steady=True)
        port.every(WATCH_PERIOD, self._watch, steady=True)

    def tell(self, instant: int) -> None:
        """Tell the time [ns since 1970]."""
        self._publisher.publish(ClockMessage(clock=stamp_of(instant)))

    def _watch(self) -> None:
        """Tell when another node makes time pass as well: it would leap to and fro."""
        self.rivals = self._port.crowd(CLOCK_TOPIC)
        if self.rivals:
            self._port.error(
                f'{self.rivals} all tell the time on {CLOCK_TOPIC}, which leaps to and fro: let '
                'all simulators but one follow (clock: follow) and play bags without their clock, '
                'or give each a ROS_DOMAIN_ID of its own',
                throttle_duration_sec=10.0,
            )
