"""The two ends of a topic in an `InProcessGraph`."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from agv_motion.errors import AgvMotionError
from agv_motion.ros.cdr import codec

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.qos import QoSProfile

    from agv_motion.ros.in_process_graph import InProcessGraph
    from agv_motion.ros.port import Ahead
    from agv_motion.ros.rows import Rows


SECOND = 1_000_000_000


class SentRow(NamedTuple):
    """A row on its way to the nodes that take rows."""

    row: Any
    frame: str


class Participant(Protocol):
    """A node's place in the graph."""

    graph: InProcessGraph
    active: bool
    message_of: Callable[[AgvMotionError], str]
    """returns the message of an error, as the node may tell it"""

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used."""


class InProcessEnd:
    """The sending end."""

    def __init__(self, port: Participant, kind: Any, topic: str, qos: QoSProfile) -> None:
        """Join the topic."""
        self.port, self.kind, self.topic, self.qos = port, kind, topic, qos
        self._encode = codec(kind).encode
        self._graph = port.graph
        self._graph.publishers.setdefault(topic, []).append(self)
        self._listeners = self._graph.listeners[topic]
        """all who listen, now or later"""

    def publish_message(self, message: Any) -> None:
        """Send a message, or the bytes of one."""
        self._graph.publish(self, message if type(message) is bytes else self._encode(message))

    def get_subscription_count(self) -> int:
        """Return how many listen, a recording included."""
        return len(self._listeners) + (self.topic in self._graph.recorded)


class InProcessPublisher(InProcessEnd):
    """The sending end of messages."""

    publish = InProcessEnd.publish_message


class InProcessRowPublisher(InProcessEnd):
    """The sending end of rows; they go as they are where all who listen take rows."""

    def __init__(self, port: Participant, rows: Rows, topic: str, qos: QoSProfile) -> None:
        """Join the topic."""
        self._message = rows.message()
        self._frame: str = self._message.header.frame_id
        super().__init__(port, type(self._message), topic, qos)
        self.rows, self._kind = rows, type(rows)

    def goes_as_it_is(self) -> bool:
        """Return whether the recording and everyone else who listens take such rows."""
        if not self._graph.takes_rows:
            return False
        return all(listener.takes is self._kind for listener in self._listeners)

    def publish(self, row: Any, stamp: int) -> None:
        """Send a row; no time passes in a callback, so ``stamp`` [ns] is that of the graph."""
        if self.goes_as_it_is():
            self._graph.publish(self, SentRow(row, self._frame))
            return
        time = self._message.header.stamp
        time.sec, time.nanosec = divmod(stamp, SECOND)
        self.rows.fill(self._message, row)
        self.publish_message(self._message)


class InProcessListener:
    """The hearing end; like that of the middleware, it is silent while its node is inactive."""

    takes: type[Rows] | None = None
    """of which rows it takes as they are; None: of none"""
    hears_itself = False

    def __init__(
        self, port: Participant, kind: Any, topic: str, callback: Callable[..., None],
        ahead: Ahead | None = None,
    ) -> None:  # fmt: skip
        """Pass the messages of one topic on to ``callback``, or to what is ``ahead``."""
        self.port, self.kind = port, kind
        self._topic, self._callback, self._ahead = topic, callback, ahead
        self._decode = codec(kind).decode
        self._prepared: deque[Any] = deque()

    def look_ahead(self, messages: list[bytes], stamps: list[int]) -> None:
        """Prepare what will be heard next."""
        if self._ahead is not None:
            self._prepared.extend(self._ahead.prepare(messages, stamps))

    def hear(self, data: Any) -> None:
        """Take a message in CDR."""
        if self._prepared:
            assert self._ahead is not None
            self._call(self._ahead.take, self._prepared.popleft())
        else:
            self._call(self._callback, self._decode(data))

    def _call(self, act: Callable[..., None], *told: Any) -> None:
        port = self.port
        if not port.active:
            return
        try:
            act(*told)
        except AgvMotionError as error:
            port.refuse(f'{self._topic}: {port.message_of(error)}')


class InProcessRowListener(InProcessListener):
    """The hearing end of rows, whether they come as they are or in messages."""

    def __init__(
        self, port: Participant, rows: Rows, topic: str, callback: Callable[..., None]
    ) -> None:
        """Pass row, frame and stamp on to ``callback``."""
        super().__init__(port, type(rows.message()), topic, callback)
        self.takes, self._read = type(rows), rows.read

    def hear(self, data: Any) -> None:
        """Take a message, or a row."""
        if isinstance(data, SentRow):
            row, frame = data
            self._call(self._callback, row, frame, self.port.graph.now)
        else:
            self._call(self._hear_message, self._decode(data))

    def _hear_message(self, message: Any) -> None:
        stamp = message.header.stamp
        taken = stamp.sec * SECOND + stamp.nanosec
        self._callback(self._read(message), message.header.frame_id, taken)
