"""The port of a node in an `InProcessGraph`: no middleware, one clock, nobody else to look out for.

The steady clock is the clock of the graph, which is always right; a defect of ours ends the run.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.clock_watch import ClockWatch
from agv_motion.errors import AgvMotionError, shortened
from agv_motion.ros.in_process_topic import (
    InProcessListener,
    InProcessPublisher,
    InProcessRowListener,
    InProcessRowPublisher,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from rclpy.qos import QoSProfile

    from agv_motion.ros.in_process_graph import InProcessGraph
    from agv_motion.ros.port import Ahead
    from agv_motion.ros.rows import Rows
    from agv_motion.watchdog import Watchdog

SECOND = 1_000_000_000
SERVICE_EVENT = '/_service_event'
"""What follows the name of a service in the topic that tells what it was asked"""


class Place(NamedTuple):
    """Where on the graph a node is, and what its topics are called there."""

    name: str
    namespace: str
    remap: Mapping[str, str]
    """full names of topics, by the full names that the node uses"""

    def full_name(self, topic: str) -> str:
        """Return the full name of a topic."""
        if topic.startswith('~'):
            topic = f'{self.name}{topic[1:]}'
        full = full_name(topic, self.namespace)
        return self.remap.get(full, full)


def full_name(topic: str, namespace: str) -> str:
    """Return the full name of a topic, which may be relative to a namespace."""
    return topic if topic.startswith('/') else f'{namespace.rstrip("/")}/{topic}'


class InProcessPort:
    """A `Port` in an `InProcessGraph`."""

    def __init__(
        self, graph: InProcessGraph, place: Place, tell: Callable[[AgvMotionError], str],
        *, is_simulated: bool = False,
    ) -> None:  # fmt: skip
        """Join the graph.

        Args:
            graph: To join.
            place: Of the node on it.
            tell: Returns the message of an error, as the node may tell it.
            is_simulated: Whether the node is to believe that its clock is simulated.

        """
        self.graph, self._place, self.message_of = graph, place, tell
        self.active = False
        self.is_simulated = is_simulated
        self.clock = ClockWatch()
        self.clock.fault = ''
        self.services: dict[str, tuple[type[Any], Callable[[Any], str]]] = {}
        """type of each service, and what it does"""

    @property
    def is_recorded(self) -> bool:
        """Whether what comes is a recording, in which the node hears what it said itself."""
        return bool(self.graph.recorded)

    @property
    def name(self) -> str:
        """Name of the node."""
        return self._place.name

    @property
    def namespace(self) -> str:
        """Namespace of the node."""
        return self._place.namespace

    # The log

    def info(self, text: str, **options: Any) -> None:
        """Leave it: only what is not as it should be is kept."""

    def warning(self, text: str, **options: Any) -> None:
        """Count what is worth a warning."""
        del options
        self.graph.note_complaint(f'{self.name}: {text}')

    error = warning

    # Topics, timers and services

    def publisher(self, kind: type[Any], topic: str, qos: QoSProfile, *, sole: bool = False) -> Any:
        """Return the sending end of a topic."""
        del sole  # nobody else is here
        return InProcessPublisher(self, kind, self.full_name(topic), qos)

    def row_publisher(
        self, rows: Rows, topic: str, qos: QoSProfile, *, sole: bool = False
    ) -> InProcessRowPublisher:
        """Return the sending end of rows, which become messages many together."""
        del sole
        return InProcessRowPublisher(self, rows, self.full_name(topic), qos)

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message while active; what is refused is counted."""
        del qos, sole
        self._add(topic, InProcessListener(self, kind, topic, callback))

    def listen_always(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile
    ) -> None:
        """Do the same: over a recording a node is active all the time."""
        self.listen(kind, topic, callback, qos)

    def listen_ahead(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], ahead: Ahead,
        qos: QoSProfile,
    ) -> None:  # fmt: skip
        """Do the same, with what was prepared in place of the messages."""
        del qos
        self._add(topic, InProcessListener(self, kind, topic, callback, ahead))

    def listen_to_rows(
        self, rows: Rows, topic: str, callback: Callable[[Any, str, int], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with row, frame and stamp [ns] of each message."""
        del qos, sole
        self._add(topic, InProcessRowListener(self, rows, topic, callback))

    def need(self, *topics: str) -> None:
        """Leave it: what is recorded is there, and nothing else will come."""

    def every(self, seconds: float, callback: Callable[[], None], *, steady: bool = False) -> None:
        """Call ``callback`` periodically while active; there is one clock."""
        del steady

        def guarded() -> None:
            if self.active:
                try:
                    callback()
                except AgvMotionError as error:
                    self.refuse(self.message_of(error))

        self.graph.add_timer(seconds, guarded)

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Do what the service was asked where that is recorded; nobody else is there to ask."""
        self.services[name] = kind, act

        def hear(event: Any) -> None:
            if event.info.event_type == event.info.REQUEST_RECEIVED:
                for request in event.request:  # none where only its envelope was recorded
                    act(request)

        self._add(f'{name}{SERVICE_EVENT}', InProcessListener(self, kind.Event, name, hear))

    def close_later(self, close: Callable[[], Any]) -> None:
        """Leave what is open to the end of the process."""

    def full_name(self, topic: str) -> str:
        """Return the full name of a topic."""
        return self._place.full_name(topic)

    def count_publishers(self, topic: str) -> int:
        """Return how many nodes publish a topic."""
        return len(self.graph.publishers.get(self.full_name(topic), ()))

    def crowd(self, topic: str) -> str:
        """Return which nodes publish a topic together, in words; empty if one or none does."""
        publishers = self.graph.publishers.get(self.full_name(topic), ())
        names = sorted(f'{one.port.namespace.rstrip("/")}/{one.port.name}' for one in publishers)
        return ', '.join(names) if len(names) > 1 else ''

    # Time

    def nanoseconds(self) -> int:
        """Return the time of the graph [ns]."""
        return self.graph.now

    def seconds(self) -> float:
        """Return the time of the graph [s]."""
        return self.graph.now * 1e-9

    steady_seconds = seconds

    def stamp(self, message: Any) -> float:
        """Set the stamp of a message's header to the time of the graph; return it [s]."""
        stamp, now = message.header.stamp, self.graph.now
        stamp.sec, stamp.nanosec = divmod(now, SECOND)
        return float(now) * 1e-9

    # Inputs

    def watch_over(self, watchdog: Watchdog) -> None:
        """Leave it: the clock has no fault."""

    def watch_inputs(self, stop_after: float, act: Callable[[], None]) -> None:
        """Call ``act`` several times within ``stop_after`` [s]."""
        self.every(min(0.1, stop_after / 4.0), act)

    def refuse(self, reason: str) -> None:
        """Count an input that was not used."""
        self.warning(f'refused: {shortened(reason)}')

    def _add(self, topic: str, listener: InProcessListener) -> None:
        self.graph.listeners[self.full_name(topic)].append(listener)
