"""What a node of rclpy holds in its hands in place of publishers, subscriptions and timers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.serialization import serialize_message

from agv_motion.ros.in_process_topic import InProcessListener, InProcessPublisher

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.qos import QoSProfile

    from agv_motion.reprocess.foreign.foreign_port import ForeignPort

SECOND = 1_000_000_000


class ForeignPublisher:
    """A publisher: what it sends is recorded, and heard by the other nodes."""

    def __init__(self, port: ForeignPort, kind: Any, topic: str, qos: QoSProfile) -> None:
        """Join a topic, by its full name."""
        self._end = InProcessPublisher(port, kind, topic, qos)
        self._port = port
        self.msg_type, self.topic, self.topic_name, self.qos_profile = kind, topic, topic, qos

    def publish(self, message: Any) -> None:
        """Send a message, or the bytes of one."""
        if not isinstance(message, (self.msg_type, bytes)):
            msg = f'{self.topic}: expected {self.msg_type.__name__}, got {type(message).__name__}'
            raise TypeError(msg)
        self._end.publish(bytes(message) if isinstance(message, bytes) else _bytes(message))

    def get_subscription_count(self) -> int:
        """Return how many listen, the recording included."""
        return self._end.get_subscription_count()

    def assert_liveliness(self) -> None:
        """Leave it: nobody watches."""

    def wait_for_all_acked(self, timeout: Any = None) -> bool:
        """Return at once: nothing is on the way."""
        del timeout
        return True

    def destroy(self) -> None:
        """Send nothing more."""


class NoPublisher:
    """A publisher of rclpy's own, of what nobody needs."""

    def publish(self, message: Any) -> None:
        """Leave it."""

    def destroy(self) -> None:
        """Leave it."""


class ForeignSubscription(InProcessListener):
    """A subscription: each message of the recording, or of a node of the graph, in its turn."""

    hears_itself = True

    def __init__(
        self, port: ForeignPort, kind: Any, topic: str, callback: Callable[[Any], Any],
        *, raw: bool = False,
    ) -> None:  # fmt: skip
        """Join a topic, by its full name."""
        super().__init__(port, kind, topic, port.guarded(callback))
        self.msg_type, self.topic, self.topic_name = kind, topic, topic
        self.callback = callback
        self.qos_profile: QoSProfile | None = None
        self._closed = False
        if raw:
            self._decode = bytes

    def hear(self, data: Any) -> None:
        """Take a message in CDR."""
        if not self._closed:
            super().hear(data)

    def get_publisher_count(self) -> int:
        """Return how many speak, the recording included."""
        graph = self.port.graph
        return len(graph.publishers.get(self.topic, ())) + (self.topic in graph.recorded)

    def destroy(self) -> None:
        """Hear nothing more."""
        self._closed = True


class ForeignTimer:
    """A timer, on the clock of the recording."""

    def __init__(
        self, port: ForeignPort, seconds: float, callback: Callable[[], Any], *, autostart: bool
    ) -> None:
        """Begin to run, unless told not to."""
        self.callback = callback
        self._port, self._period = port, max(round(seconds * SECOND), 1)
        self._act = port.guarded(callback)
        self._order: int | None = None
        self._last = self._next = port.graph.now
        if autostart:
            self.reset()

    @property
    def timer_period_ns(self) -> int:
        """[ns]."""
        return self._period

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self._period = max(int(value), 1)
        if self._order is not None:
            self.reset()

    def is_canceled(self) -> bool:
        """Return whether it stands."""
        return self._order is None

    def is_ready(self) -> bool:
        """Return whether it is due."""
        return self._order is not None and self._port.graph.now >= self._next

    def time_since_last_call(self) -> int:
        """Return how long ago it was called last [ns]."""
        return self._port.graph.now - self._last

    def time_until_next_call(self) -> int | None:
        """Return how long until it is called [ns]; None while it stands."""
        return None if self._order is None else self._next - self._port.graph.now

    def cancel(self) -> None:
        """Stand until `reset`."""
        if self._order is not None:
            self._port.graph.drop_timer(self._order)
            self._order = None

    def reset(self) -> None:
        """Run, a whole period from now on."""
        self.cancel()
        graph = self._port.graph
        self._next = graph.now + self._period
        self._order = graph.add_timer(self._period / SECOND, self._run)

    destroy = cancel

    def _run(self) -> None:
        self._last, self._next = self._port.graph.now, self._port.graph.now + self._period
        if self._port.active:
            self._act()


def _bytes(message: Any) -> bytes:
    return bytes(serialize_message(message))
