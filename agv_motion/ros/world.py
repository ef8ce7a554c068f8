"""Topics, timers and a clock within one process, in place of the middleware.

Time is what the world is told, and messages are heard in the order of their sending, so a run is
the same to the bit whenever and wherever it is made.
"""

from __future__ import annotations

import heapq
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.lifecycle import TransitionCallbackReturn

from agv_motion.errors import ConfigurationError
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    import numpy as np
    from numpy.typing import NDArray
    from rclpy.qos import QoSProfile


class Instant(NamedTuple):
    """A time, with the two faces of rclpy's that nodes use."""

    nanoseconds: int

    def to_msg(self) -> Any:
        """Return a builtin_interfaces/Time."""
        return stamp_of(self.nanoseconds)


class World:
    """Topics by name, timers by time, and the clock of all nodes in it."""

    def __init__(self, record: Callable[[Publisher, int, Any], None], now: int) -> None:
        """Start at a time, with no node.

        Args:
            record: Called with each message that a node publishes, and its time [ns]; of a
                publisher whose rows become messages many together, with the row.
            now: [ns] of the clock.

        """
        self.now = now
        self.record = record
        self.recorded: Collection[str] = ()
        """topics that someone listens to beside the nodes"""
        self.nodes: list[Any] = []
        self.complaints: dict[str, int] = {}
        """what the nodes warned of, and how often"""
        self.listeners: dict[str, list[Listener]] = {}
        self.publishers: dict[str, list[Publisher]] = {}
        self._timers: list[tuple[int, int, Timer]] = []
        self._count = 0
        self._waiting: deque[tuple[Listener, Any]] = deque()
        self._running = False

    def start(self) -> None:
        """Activate all nodes; what they say at once is heard when all of them are active."""
        for node in self.nodes:
            require_success(node.on_activate(None), node)
        self._running = True
        self._pass_on()

    def stop(self) -> None:
        """Deactivate all nodes, first to last."""
        self._pass_on()
        for node in self.nodes:
            node.on_deactivate(None)
            self._pass_on()

    def look_ahead(self, topic: str, messages: list[bytes], stamps: list[int]) -> None:
        """Show the messages that :meth:`feed` will bring next on a topic, and when [ns]."""
        for listener in self.listeners.get(topic, ()):
            listener.look_ahead(messages, stamps)

    def feed(self, topic: str, stamp: int, data: bytes) -> None:
        """Let timers run up to ``stamp`` [ns], then let a message from outside be heard.

        A timer that is due at the same time comes first, as it does where `/clock` drives both;
        but not before what its own node has made of that time when it was recorded. What the
        nodes say to it is heard when all messages from outside of the same time have been: it took
        one way more, and what was measured together arrives before what was computed of a part.
        """
        if stamp > self.now:
            self._pass_on()
        self.run(stamp - 1 if self.publishers.get(topic) else stamp)
        self.now = stamp
        for listener in self.listeners.get(topic, ()):
            listener.hear(data)

    def run(self, stamp: int) -> None:
        """Run the timers that are due until ``stamp`` [ns]."""
        timers = self._timers
        if stamp > self.now:
            self._pass_on()
        while timers and timers[0][0] <= stamp:
            due, order, timer = timers[0]
            if timer.callback is None:
                heapq.heappop(timers)
                continue
            heapq.heapreplace(timers, (due + timer.period, order, timer))
            self.now = due
            timer.callback()
            if self._waiting:
                self._pass_on()

    def inputs(self) -> set[str]:
        """Return the topics that have to come from outside: no other node publishes them."""
        return {
            topic
            for topic, listeners in self.listeners.items()
            if all(
                publisher.node is listener.node
                for listener in listeners
                for publisher in self.publishers.get(topic, ())
            )
        }

    def add_timer(self, timer: Timer) -> None:
        """Let a timer run, first after its period."""
        self._count += 1
        heapq.heappush(self._timers, (self.now + timer.period, self._count, timer))

    def publish(self, publisher: Publisher, data: Any) -> None:
        """Record a message in bytes, or a row, and let the other nodes hear it."""
        self.record(publisher, self.now, data)
        for listener in self.listeners.get(publisher.topic, ()):
            if listener.node is not publisher.node:
                self._waiting.append((listener, data))

    def _pass_on(self) -> None:
        """Let messages be heard in the order of their sending."""
        waiting = self._waiting
        while waiting and self._running:
            listener, data = waiting.popleft()
            listener.hear(data)


def require_success(result: TransitionCallbackReturn, node: Any) -> None:
    """Raise what a node logged, unless its transition succeeded.

    Raises:
        ConfigurationError: It did not.

    """
    if result is not TransitionCallbackReturn.SUCCESS:
        msg = f'{node.get_name()} {node.get_logger().last}'
        raise ConfigurationError(msg)


class Publisher:
    """One end of a topic."""

    def __init__(self, node: Any, kind: Any, topic: str, qos: QoSProfile) -> None:
        """Join the topic."""
        self.node, self.kind, self.topic, self.qos = node, kind, topic, qos
        self._encode = codec(kind).encode
        self.together: Callable[[NDArray[np.int64], list[Any]], list[bytes]] | None = None
        """makes messages of the times [ns] and values of many rows"""
        self._world: World = node.world
        self._world.publishers.setdefault(topic, []).append(self)

    def publish(self, message: Any) -> None:
        """Send a message, or the bytes of one."""
        self._world.publish(self, message if type(message) is bytes else self._encode(message))

    def publish_row(self, row: Any) -> bool:
        """Send a row, unless someone listens who takes nothing but messages."""
        if self.together is None:
            return False
        for listener in self._world.listeners.get(self.topic, ()):
            if not listener.takes_rows:
                return False
        self._world.publish(self, row)
        return True

    def get_subscription_count(self) -> int:
        """Return how many listen, a recording included."""
        listeners = self._world.listeners.get(self.topic, ())
        return len(listeners) + (self.topic in self._world.recorded)

    def wait_for_all_acked(self, _: Any = None) -> bool:
        """Return that all have heard."""
        return True


class Listener:
    """The other end."""

    def __init__(self, node: Any, kind: Any, callback: Callable[[Any], None]) -> None:
        """Pass the messages of one topic on to ``callback``."""
        self.node, self.kind, self.callback = node, kind, callback
        self._decode = codec(kind).decode
        self.prepare: Callable[[list[bytes], list[int]], list[Any]] | None = None
        """makes of many messages, and when they come [ns], what the callback takes; of none if it
        cannot"""
        self._prepared: deque[Any] = deque()
        self.takes_rows = False
        """whether the callback takes the rows of other nodes"""

    def look_ahead(self, messages: list[bytes], stamps: list[int]) -> None:
        """Prepare what will be heard next."""
        if self.prepare is not None:
            self._prepared.extend(self.prepare(messages, stamps))

    def hear(self, data: Any) -> None:
        """Take a message in bytes, or a row."""
        if type(data) is not bytes:
            self.callback(data)
        else:
            self.callback(self._prepared.popleft() if self._prepared else self._decode(data))


class Timer:
    """Calls again and again, until it is destroyed."""

    def __init__(self, seconds: float, callback: Callable[[], None]) -> None:
        """Wait for the world to add it."""
        self.period = max(round(seconds * 1e9), 1)
        self.callback: Callable[[], None] | None = callback


class Clock:
    """The world's clock, in the form of rclpy's."""

    def __init__(self, world: World) -> None:
        """Show the time of ``world``."""
        self._world = world
        self.handle = self

    def get_now(self) -> Instant:
        """Return the time."""
        return Instant(self._world.now)

    now = get_now


class Logger:
    """Keeps what is worth a warning, instead of printing it."""

    def __init__(self, name: str, complaints: dict[str, int]) -> None:
        """Keep it in ``complaints``."""
        self._name, self._complaints = name, complaints
        self.last = ''

    def info(self, *_: Any, **__: Any) -> None:
        """Leave it."""

    debug = info

    def warning(self, message: str, **_: Any) -> None:
        """Count it."""
        self.last = message
        key = f'{self._name}: {message}'
        if key in self._complaints or len(self._complaints) < MOST_COMPLAINTS:
            self._complaints[key] = self._complaints.get(key, 0) + 1

    error = fatal = warn = warning


MOST_COMPLAINTS = 1000
"""different ones that are kept"""
