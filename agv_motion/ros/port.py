"""What a node is given of the world: topics, timers, services, clocks and a log.

A node does not know whether its port is live (`live_port`: a node of rclpy, the middleware, the
clock on the wall) or in process (`in_process_port`: a recording, a test, another clock).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.qos import QoSProfile

    from agv_motion.clock_watch import ClockWatch
    from agv_motion.errors import AgvMotionError
    from agv_motion.ros.rows import Rows
    from agv_motion.watchdog import Watchdog


class Publisher(Protocol):
    """The sending end of a topic."""

    def publish(self, message: Any) -> None:
        """Send a message, or the bytes of one in CDR."""

    def get_subscription_count(self) -> int:
        """Return how many listen."""


class RowPublisher(Protocol):
    """The sending end of a topic whose messages are made of rows of numbers."""

    def publish(self, row: Any, stamp: int) -> None:
        """Send a row as a message stamped with ``stamp`` [ns]."""

    def publish_message(self, message: Any) -> None:
        """Send a message of the same class that is no row."""

    def get_subscription_count(self) -> int:
        """Return how many listen."""


class Ahead(NamedTuple):
    """How a node takes many messages at once, where it is known which will come (a recording)."""

    prepare: Callable[[list[bytes], list[int]], list[Any]]
    """makes of messages in CDR, and the times when they will come [ns], one item each; none at all
    where that would not lead to the same as taking them one by one"""
    take: Callable[[Any], None]
    """called with each item when its message comes, in place of the callback"""


class Port(Protocol):
    """What a node uses of the world; all it opens is closed for it."""

    @property
    def name(self) -> str:
        """Name of the node, without its namespace."""

    @property
    def namespace(self) -> str:
        """Namespace of the node, such as ``/oak``."""

    @property
    def active(self) -> bool:
        """Whether the node acts; its callbacks are called only while it does."""

    # The log

    def info(self, text: str, **options: Any) -> Any:
        """Log what a person may want to know; options such as ``throttle_duration_sec``."""

    def warning(self, text: str, **options: Any) -> Any:
        """Log what is not as it should be."""

    def error(self, text: str, **options: Any) -> Any:
        """Log what keeps the node from its work."""

    # Topics, timers and services

    def publisher(self, kind: type[Any], topic: str, qos: QoSProfile, *, sole: bool = False) -> Any:
        """Return a `Publisher` of messages of class ``kind``.

        Where it is the ``sole`` one that a robot may have, the node acts only as long as there is
        no other on the graph; tools of a person, such as `agv topic pub`, are told but let be.
        """

    def row_publisher(
        self, rows: Rows, topic: str, qos: QoSProfile, *, sole: bool = False
    ) -> RowPublisher:
        """Return a publisher of rows, which become messages as ``rows`` tells."""

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message; an `AgvMotionError` that it raises is told.

        What is latched and comes while the node is inactive is heard at its activation. Where the
        messages should come from a ``sole`` node, it is told when several publish them.
        """

    def listen_always(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile
    ) -> None:
        """Do the same, but what came last while the node was inactive is heard in any case."""

    def listen_ahead(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], ahead: Ahead,
        qos: QoSProfile,
    ) -> None:  # fmt: skip
        """Do the same, but for messages that are known before they come; see `Ahead`."""

    def listen_to_rows(
        self, rows: Rows, topic: str, callback: Callable[[Any, str, int], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with row, frame and stamp [ns] of each message."""

    def need(self, *topics: str) -> None:
        """Tell at the start where nobody publishes ``topics``, which the node cannot do without."""

    def every(self, seconds: float, callback: Callable[[], None], *, steady: bool = False) -> None:
        """Call ``callback`` periodically, on the node's clock or on the ``steady`` one."""

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Offer a service: ``act`` returns in words what was done, or raises why not.

        The answer is `success`, and `message` where its type has that.
        """

    def close_later(self, close: Callable[[], Any]) -> None:
        """Call ``close`` at the end, after what is opened from now on has been closed."""

    def full_name(self, topic: str) -> str:
        """Return the name of a topic on the graph, which may be remapped."""

    def count_publishers(self, topic: str) -> int:
        """Return how many nodes publish a topic."""

    def crowd(self, topic: str) -> str:
        """Return which nodes publish a topic together, in words; empty if one or none does."""

    # Time

    @property
    def clock(self) -> ClockWatch:
        """Whether the node's clock can be believed; while it has a fault, inputs are lost."""

    @property
    def is_simulated(self) -> bool:
        """Whether the node's clock is simulated (`use_sim_time`)."""

    @property
    def is_recorded(self) -> bool:
        """Whether what comes is a recording, in which the node hears what it said itself."""

    def seconds(self) -> float:
        """Return the time of the node's clock [s]."""

    def nanoseconds(self) -> int:
        """Return the time of the node's clock [ns]."""

    def steady_seconds(self) -> float:
        """Return the time of a clock that never leaps, stands or is simulated [s]."""

    def stamp(self, message: Any) -> float:
        """Set the stamp of a message's header to now; return now [s]."""

    # Inputs

    def watch_over(self, watchdog: Watchdog) -> None:
        """Take an input for lost until it comes again, whenever the clock has a fault."""

    def watch_inputs(self, stop_after: float, act: Callable[[], None]) -> None:
        """Call ``act``, which stops where an input is lost, at once when the clock has a fault.

        And else several times within ``stop_after`` [s], by the steady clock.
        """

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used, in the log and in the diagnostics."""

    def message_of(self, error: AgvMotionError) -> str:
        """Return the message of an error, without a word of a file that is not for everyone."""
