"""A graph of nodes within one process, in place of the middleware: topics, timers and one clock.

Time is what the graph is told, and messages are heard in the order of their sending, so a run is
the same to the bit whenever and wherever it is made.
"""

from __future__ import annotations

import heapq
from collections import defaultdict, deque
from itertools import count
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

MOST_COMPLAINTS = 1000
"""different ones that are kept"""


class Sender(Protocol):
    """What sends on a topic."""

    topic: str
    kind: Any
    """class of its messages"""
    port: Any
    """of its node"""


class Hearer(Protocol):
    """What hears on a topic."""

    port: Any
    """of its node"""
    takes: type[Any] | None
    """of which rows it takes as they are; None: of none"""
    hears_itself: bool
    """whether it hears what its own node says, as on the middleware; else the recording of that"""

    def look_ahead(self, messages: list[bytes], stamps: list[int]) -> None:
        """Prepare what will be heard next."""

    def hear(self, data: Any) -> None:
        """Take a message."""


class GraphMember(Protocol):
    """A node of the graph."""

    def activate(self) -> None:
        """Let it act."""

    def deactivate(self) -> None:
        """Let it leave its outputs safe."""


class InProcessGraph:
    """Topics by name, timers by time, and the clock of all nodes in it."""

    def __init__(self, record: Callable[[Any, int, Any], None], now: int) -> None:
        """Start at a time, with no node.

        Args:
            record: Called with each message that a node publishes, and its time [ns].
            now: [ns] of the clock.

        """
        self.now = now
        self.record = record
        self.recorded: Collection[str] = ()
        """topics that someone listens to beside the nodes"""
        self.takes_rows = False
        """whether ``record`` takes the rows of `InProcessRowPublisher` in place of messages"""
        self.nodes: list[GraphMember] = []
        self.complaints: dict[str, int] = {}
        """what the nodes warned of, and how often"""
        self.listeners: defaultdict[str, list[Hearer]] = defaultdict(list)
        self.publishers: dict[str, list[Sender]] = {}
        self._timers: list[tuple[int, int, int, Callable[[], None]]] = []
        """when each is due [ns], its number, its period [ns], and what it calls"""
        self._orders = count()
        self._dropped: set[int] = set()
        """numbers of timers that are no more"""
        self._waiting: deque[tuple[Hearer, Any]] = deque()
        self._running = False

    def start(self) -> None:
        """Activate all nodes; what they say at once is heard when all of them are active.

        Raises:
            ConfigurationError: One of them cannot begin.

        """
        for node in self.nodes:
            node.activate()
        self._running = True
        self._pass_on()

    def stop(self) -> None:
        """Deactivate all nodes, first to last."""
        self._pass_on()
        for node in self.nodes:
            node.deactivate()
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
            due, order, period, callback = timers[0]
            if order in self._dropped:
                heapq.heappop(timers)
                self._dropped.discard(order)
                continue
            heapq.heapreplace(timers, (due + period, order, period, callback))
            self.now = due
            callback()
            if self._waiting:
                self._pass_on()

    def inputs(self) -> set[str]:
        """Return the topics that have to come from outside: no other node publishes them."""
        return {
            topic
            for topic, listeners in self.listeners.items()
            if listeners
            and all(
                publisher.port is listener.port and not listener.hears_itself
                for listener in listeners
                for publisher in self.publishers.get(topic, ())
            )
        }

    def add_timer(self, seconds: float, callback: Callable[[], None]) -> int:
        """Call ``callback`` every ``seconds``, not at once; return the number of the timer."""
        period, order = max(round(seconds * 1e9), 1), next(self._orders)
        heapq.heappush(self._timers, (self.now + period, order, period, callback))
        return order

    def drop_timer(self, order: int) -> None:
        """Call a timer no more."""
        self._dropped.add(order)

    def publish(self, publisher: Sender, data: Any) -> None:
        """Record a message in bytes, or a row, and let the other nodes hear it."""
        self.record(publisher, self.now, data)
        for listener in self.listeners.get(publisher.topic, ()):
            if listener.port is not publisher.port or listener.hears_itself:
                self._waiting.append((listener, data))

    def note_complaint(self, text: str) -> None:
        """Count what a node warned of."""
        complaints = self.complaints
        if text in complaints or len(complaints) < MOST_COMPLAINTS:
            complaints[text] = complaints.get(text, 0) + 1

    def _pass_on(self) -> None:
        """Let messages be heard in the order of their sending."""
        waiting = self._waiting
        while waiting and self._running:
            listener, data = waiting.popleft()
            listener.hear(data)
