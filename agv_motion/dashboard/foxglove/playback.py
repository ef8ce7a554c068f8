"""A bag as one client plays it: where it stands, what is due, and what was known before a leap.

Nothing is dropped: where more is due than a client takes, the time of the bag waits for it. Every
method is told the present time ``now`` [s].
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from agv_motion.bag.last_messages import last_before
from agv_motion.bag.playback.timeline import Timeline
from agv_motion.dashboard.foxglove.protocol import PlaybackStatus
from agv_motion.dashboard.foxglove.requests import ProtocolError
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.bag.connection import Message
    from agv_motion.bag.reader import BagReader

SLOWEST, FASTEST = 0.01, 100.0
"""[s] of the bag in a second"""
MOST_AT_ONCE = 2000
"""messages of one look"""
LARGEST_AT_ONCE = 4 * 1024 * 1024
"""[bytes] of one look"""
PATIENCE = 1.0
"""[s] of looking back for what was said last on topics that nobody latches"""
SECOND = 1_000_000_000


class BagViewing:
    """One bag, played for one client."""

    def __init__(self, bag: BagReader, rate: float = 1.0) -> None:
        """Stand at the beginning.

        Args:
            bag: For this client alone; closed by `close`.
            rate: Seconds of it in a second.

        Raises:
            ProtocolError: The rate is out of range.

        """
        self._bag = bag
        require_rate(rate)
        self._timeline = Timeline(bag.start, rate)
        self._topics: frozenset[str] = frozenset()
        self._messages: Iterator[Message] = iter(())
        self._next: Message | None = None
        self._before: list[Message] = []
        """what was said last before a leap, to be sent first"""
        self.failure = ''
        """why it can be played no further"""

    @property
    def begin(self) -> int:
        """Time of its first message [ns]."""
        return self._bag.start

    @property
    def end(self) -> int:
        """Time of its last message [ns]."""
        return self._bag.end

    @property
    def rate(self) -> float:
        """Seconds of the bag in a second, while it plays."""
        return self._timeline.rate

    def position(self, now: float) -> int:
        """Return the time of the bag [ns]."""
        return min(max(self._timeline.position(now), self.begin), self.end)

    def status(self, now: float) -> PlaybackStatus:
        """Return what it does."""
        if self.failure or self._timeline.position(now) > self.end:
            return PlaybackStatus.ENDED
        return PlaybackStatus.PAUSED if self._timeline.paused else PlaybackStatus.PLAYING

    def play(self, now: float) -> None:
        """Go on."""
        self._timeline.resume(now)

    def pause(self, now: float) -> None:
        """Stand still."""
        self._timeline.pause(now)

    def set_rate(self, rate: float, now: float) -> None:
        """Go faster or slower.

        Raises:
            ProtocolError: The rate is out of range.

        """
        require_rate(rate)
        self._timeline.set_rate(rate, now)

    def choose(self, topics: Iterable[str], now: float) -> None:
        """Play these topics; of those that are new, what was said last comes first."""
        chosen = frozenset(topics)
        if chosen == self._topics:
            return
        new, self._topics = chosen - self._topics, chosen
        self._open(self.position(now), new)

    def seek(self, stamp: int, now: float) -> None:
        """Go to a time of the bag [ns], the nearest that it has; what was said last comes first."""
        place = min(max(stamp, self.begin), self.end)
        self._timeline.jump(place, now)
        self._open(place, self._topics)

    def due(self, now: float) -> list[tuple[str, int, bytes]]:
        """Return what is due: topic, time [ns] and data; what was said before a leap first."""
        place = self.position(now)
        found = [(one.connection.topic, place, one.data) for one in self._before]
        self._before = []
        size = 0
        try:
            while self._next is not None and self._next.stamp <= place:
                if len(found) >= MOST_AT_ONCE or size >= LARGEST_AT_ONCE:
                    self._timeline.jump(self._next.stamp, now)  # the bag waits for its client
                    break
                found.append((self._next.connection.topic, self._next.stamp, self._next.data))
                size += len(self._next.data)
                self._next = next(self._messages, None)
        except AgvMotionError as error:
            self.failure, self._next = str(error), None
        return found

    def hold(self, now: float) -> None:
        """Let the bag wait: its client has not taken what is due."""
        if self._next is not None and self._next.stamp < self.position(now):
            self._timeline.jump(self._next.stamp, now)

    def close(self) -> None:
        """Let go of the bag."""
        self._bag.close()

    def _open(self, place: int, new: frozenset[str]) -> None:
        """Play on from a time, and find what was said last before it on ``new`` topics."""
        self.failure, self._messages, self._next = '', iter(()), None
        latched = {
            one.topic for one in self._bag.connections if one.latched and one.topic in new
        }  # fmt: skip
        end = time.monotonic() + PATIENCE
        try:
            before = last_before(self._bag, latched, place)
            before |= last_before(self._bag, new - latched, place, lambda: time.monotonic() > end)
            kept = [one for one in self._before if one.connection.topic in self._topics - new]
            self._before = sorted([*kept, *before.values()], key=lambda one: one.stamp)
            if self._topics:
                self._messages = self._bag.messages(self._topics, place)
                self._next = next(self._messages, None)
        except AgvMotionError as error:
            self.failure = str(error)


def require_rate(rate: Any) -> None:
    """Refuse a rate that cannot be played.

    Raises:
        ProtocolError: It is none, or out of range.

    """
    number = isinstance(rate, (int, float)) and not isinstance(rate, bool)
    if not number or not SLOWEST <= rate <= FASTEST:
        msg = f'rate = {str(rate)[:40]}: must lie in [{SLOWEST:g}, {FASTEST:g}]'
        raise ProtocolError(msg)
