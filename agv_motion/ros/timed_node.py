"""The two clocks of a node: its own, which may be simulated and is watched, and the steady one."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, ClockType
from rclpy.lifecycle import LifecycleNode

from agv_motion.ros.clock_guard import CLOCK_TOPIC, ClockGuard, if_possible

if TYPE_CHECKING:
    from agv_motion.clock_watch import ClockWatch
    from agv_motion.watchdog import Watchdog


class TimedNode(LifecycleNode):
    """A lifecycle node that knows whether its clock can be believed."""

    def __init__(self, name: str, **kwargs: Any) -> None:
        """Have looked at no clock yet."""
        super().__init__(name, **kwargs)
        self.active = False
        self._now = self.get_clock().handle.get_now
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._clock_guard = ClockGuard(self)
        self.clock: ClockWatch = self._clock_guard.watch
        """Whether the node's clock can be believed; while it has a fault, inputs are lost"""

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used."""
        raise NotImplementedError

    def nanoseconds(self) -> int:
        """Return the time of the node's clock [ns], simulated where `use_sim_time` is set."""
        return int(self._now().nanoseconds)

    def seconds(self) -> float:
        """Return the time of the node's clock [s], simulated where `use_sim_time` is set."""
        return float(self._now().nanoseconds) * 1e-9

    def steady_seconds(self) -> float:
        """Return the time of a clock that never leaps, stands or is simulated [s]."""
        return time.monotonic()

    def stamp(self, message: Any) -> float:
        """Set the stamp of a message's header to now, without a new object; return now [s]."""
        stamp, now = message.header.stamp, self._now().nanoseconds
        stamp.sec, stamp.nanosec = divmod(now, 1_000_000_000)
        return float(now) * 1e-9

    def watch_over(self, watchdog: Watchdog) -> None:
        """Take an input for lost until it comes again, whenever the clock has a fault."""
        self._clock_guard.add(watchdog)

    def wake(self) -> None:
        """Judge the inputs before anything else, where the node has not run for too long."""
        self._clock_guard.wake()

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Any, *args: Any, **kwargs: Any
    ) -> Any:
        """Create a subscription; a time on /clock that rclpy could not bear ends no node."""
        if topic == CLOCK_TOPIC:
            callback = if_possible(self, callback)
        return super().create_subscription(msg_type, topic, callback, *args, **kwargs)
