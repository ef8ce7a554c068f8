"""The port of a node on a ROS graph: rclpy, with its gaps closed and its inputs guarded."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, ClockType

from agv_motion.ros.clock_guard import ClockGuard
from agv_motion.ros.ends import Ends
from agv_motion.ros.graph_ends import full_name, names

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.lifecycle import LifecycleNode
    from rclpy.qos import QoSProfile

    from agv_motion.clock_watch import ClockWatch
    from agv_motion.errors import AgvMotionError
    from agv_motion.ros.complaints import Complaints
    from agv_motion.ros.graph_guard import GraphGuard
    from agv_motion.ros.port import Ahead, RowPublisher
    from agv_motion.ros.rows import Rows
    from agv_motion.watchdog import Watchdog

    StopFor = Callable[[str, Exception], str]

SECOND = 1_000_000_000


class LivePort:
    """A `Port` on rclpy; ``node`` is for those that are nothing without a graph."""

    def __init__(
        self, node: LifecycleNode, graph: GraphGuard, complaints: Complaints,
        tell: Callable[[AgvMotionError], str], stop_for: StopFor,
    ) -> None:  # fmt: skip
        """Open nothing yet.

        Args:
            node: Of rclpy, which lives as long as the port.
            graph: Looks who else is on the topics of the node.
            complaints: Logs what was refused.
            tell: Returns the message of an error, as the node may tell it.
            stop_for: Deactivates the node for a defect; returns it in words.

        """
        self.node, self.message_of, self.stop_for = node, tell, stop_for
        self.active = False
        self._now = node.get_clock().handle.get_now
        self._log = node.get_logger()
        self.graph, self.complaints = graph, complaints
        self.clock_guard = ClockGuard(self)
        self.clock: ClockWatch = self.clock_guard.watch
        self.ends = Ends(node, self)

    @property
    def name(self) -> str:
        """Name of the node."""
        return str(self.node.get_name())

    @property
    def namespace(self) -> str:
        """Namespace of the node."""
        return str(self.node.get_namespace())

    # The log: rclpy counts what is said seldom by the line that calls, which is the node's

    @property
    def info(self) -> Callable[..., Any]:
        """What logs what a person may want to know."""
        return self._log.info  # type: ignore[no-any-return]

    @property
    def warning(self) -> Callable[..., Any]:
        """What logs what is not as it should be."""
        return self._log.warning  # type: ignore[no-any-return]

    @property
    def error(self) -> Callable[..., Any]:
        """What logs what keeps the node from its work."""
        return self._log.error  # type: ignore[no-any-return]

    # Topics, timers and services

    def publisher(self, kind: type[Any], topic: str, qos: QoSProfile, *, sole: bool = False) -> Any:
        """Return a publisher of rclpy that lives until cleanup."""
        self.graph.add(kind, topic, qos, publishes=True, sole=sole)
        return self.ends.publisher(kind, topic, qos)

    def row_publisher(
        self, rows: Rows, topic: str, qos: QoSProfile, *, sole: bool = False
    ) -> RowPublisher:
        """Return what publishes each row at once, in one message that is filled again and again."""
        message = rows.message()
        return _RowPublisher(rows, message, self.publisher(type(message), topic, qos, sole=sole))

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message while active; what it raises is told, not fatal."""
        self.graph.add(kind, topic, qos, publishes=False, sole=sole)
        self.ends.listen(kind, topic, callback, qos)

    def listen_always(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile
    ) -> None:
        """Do the same, but what came last while the node was inactive is heard in any case."""
        self.graph.add(kind, topic, qos, publishes=False, sole=False)
        self.ends.listen(kind, topic, callback, qos, kept=True)

    def listen_ahead(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], ahead: Ahead,
        qos: QoSProfile,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message: nobody knows here what will come."""
        del ahead
        self.listen(kind, topic, callback, qos)

    def listen_to_rows(
        self, rows: Rows, topic: str, callback: Callable[[Any, str, int], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with row, frame and stamp [ns] of each message."""
        read = rows.read

        def take(message: Any) -> None:
            header = message.header
            stamp = header.stamp.sec * SECOND + header.stamp.nanosec
            callback(read(message), header.frame_id, stamp)

        self.listen(type(rows.message()), topic, take, qos, sole=sole)

    def need(self, *topics: str) -> None:
        """Tell at the start where nobody publishes ``topics``, which the node cannot do without."""
        self.graph.need(*topics)

    def every(self, seconds: float, callback: Callable[[], None], *, steady: bool = False) -> None:
        """Call ``callback`` periodically while active."""
        self.ends.every(
            seconds, callback, Clock(clock_type=ClockType.STEADY_TIME) if steady else None
        )

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Offer a service."""
        self.ends.serve(kind, name, act)

    def close_later(self, close: Callable[[], Any]) -> None:
        """Call ``close`` at the cleanup, after what is opened from now on has been closed."""
        self.ends.add(close)

    def full_name(self, topic: str) -> str:
        """Return the name of a topic on the graph."""
        return str(self.node.resolve_topic_name(topic))

    def count_publishers(self, topic: str) -> int:
        """Return how many nodes publish a topic."""
        return int(self.node.count_publishers(self.full_name(topic)))

    def crowd(self, topic: str) -> str:
        """Return which nodes publish a topic together, in words; empty if one or none does."""
        if self.count_publishers(topic) < 2:
            return ''
        ends = self.node.get_publishers_info_by_topic(topic)
        return names(sorted(ends, key=full_name)) if len(ends) > 1 else ''

    # Time

    @property
    def is_simulated(self) -> bool:
        """Whether the node's clock is simulated."""
        return bool(self.node.get_parameter('use_sim_time').value)

    @property
    def is_recorded(self) -> bool:
        """Whether what comes is a recording: never, as far as a live node can know."""
        return False

    def nanoseconds(self) -> int:
        """Return the time of the node's clock [ns]."""
        return int(self._now().nanoseconds)

    def seconds(self) -> float:
        """Return the time of the node's clock [s]."""
        return float(self._now().nanoseconds) * 1e-9

    def steady_seconds(self) -> float:
        """Return the time of a clock that never leaps, stands or is simulated [s]."""
        return time.monotonic()

    def stamp(self, message: Any) -> float:
        """Set the stamp of a message's header to now, without a new object; return now [s]."""
        stamp, now = message.header.stamp, self._now().nanoseconds
        stamp.sec, stamp.nanosec = divmod(now, SECOND)
        return float(now) * 1e-9

    # Inputs

    def watch_over(self, watchdog: Watchdog) -> None:
        """Take an input for lost until it comes again, whenever the clock has a fault."""
        self.clock_guard.add(watchdog)

    def watch_inputs(self, stop_after: float, act: Callable[[], None]) -> None:
        """Call ``act`` at once when the clock has a fault, and several times in ``stop_after``."""
        self.every(min(0.1, stop_after / 4.0), act, steady=True)
        self.clock_guard.on_fault(act)

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used, in the log and in the diagnostics."""
        self.complaints.refuse(reason)

    # What its ends need

    def wake(self) -> None:
        """Judge the inputs first, where nothing has run for a while."""
        self.clock_guard.wake()

    def inform(self, text: str) -> None:
        """Log what was done; of repeats only some, with their number."""
        self.complaints.inform(text)


class _RowPublisher:
    """Fills and publishes one message after the other."""

    def __init__(self, rows: Rows, message: Any, publisher: Any) -> None:
        self._fill, self._message, self._stamp = rows.fill, message, message.header.stamp
        self.publish_message = publisher.publish
        self.get_subscription_count = publisher.get_subscription_count

    def publish(self, row: Any, stamp: int) -> None:
        time, message = self._stamp, self._message
        time.sec, time.nanosec = divmod(stamp, SECOND)
        self._fill(message, row)
        self.publish_message(message)
