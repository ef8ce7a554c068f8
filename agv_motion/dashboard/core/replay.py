"""A bag, looked back into: the same board, fed with what was recorded instead of what is said now.

The bag may still be written: what came since it was opened is found when it is opened again.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from agv_motion.bag.cdr.message_decoder import MessageDecoder
from agv_motion.bag.last_messages import last_before
from agv_motion.dashboard.core.board import SLOWLY, Board
from agv_motion.dashboard.core.names import SIGNS, split, type_of
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.reader import BagReader

BEFORE = 120.0
"""[s] of the past that are replayed at once for the trail, before the moment that was asked for"""
PATIENCE = 3.0
"""[s] of looking further back for what was said last; what is older stays unknown"""
SECOND = 1_000_000_000


class Replay:
    """The robots of a bag at a moment, and from there on."""

    def __init__(
        self,
        open_bag: Callable[[], BagReader],
        at: float,
        platforms: Mapping[str, dict[str, Any]] | None = None,
    ) -> None:
        """Know at once what was known at a moment.

        Args:
            open_bag: Opens the bag as it is now.
            at: The moment [s since 1970, as the bag's log times].
            platforms: Shapes of robots, by name.

        Raises:
            AgvMotionError: There is no bag, or it cannot be read at all.

        """
        self._open_bag = open_bag
        self.board = Board()
        self.at = at
        """up to where the board knows [s]"""
        self._decoders: dict[tuple[str, str], MessageDecoder | None] = {}
        self._bag = open_bag()
        self._messages: Iterator[Message] = iter(())
        self._next: Message | None = None
        self._meet_robots()
        for robot, platform in (platforms or {}).items():
            if robot in self.board.robots:
                self.board.set_platform(robot, platform)
        self._begin(at)

    def advance(self, until: float) -> None:
        """Take what was recorded until before a moment [s]; the bag's end is no end of time."""
        if self._next is None and until > self.at:
            self._reopen()
        looked = self.at
        while self._next is not None and self._next.stamp < until * SECOND:
            now = self._next.stamp / SECOND
            if now - looked >= SLOWLY:
                self.board.look(now)
                looked = now
            self._take(self._next)
            self._step()
        self.at = max(until, self.at)

    def close(self) -> None:
        """Let go of the bag."""
        self._bag.close()

    def _meet_robots(self) -> None:
        for topic in self._bag.topics:
            known = split(topic)
            if known is not None and known[1] in SIGNS:
                self.board.robot(known[0])

    def _topics(self) -> list[str]:
        """Return the topics of the bag that the page knows, of robots that it shows."""
        found = []
        for topic, connection in self._bag.topics.items():
            known = split(topic)
            if known and connection.type == type_of(known[1]):
                found.append(topic)
        return found

    def _begin(self, at: float) -> None:
        """Take what was said last before the moment, and the last minutes in their order."""
        stamp, first = int(at * SECOND), int(max(at - BEFORE, 0.0) * SECOND)
        topics, end = self._topics(), time.monotonic() + PATIENCE
        for message in last_before(
            self._bag, topics, first, lambda: time.monotonic() > end
        ).values():
            self._take(message)
        self._open(topics, first)
        self.at = first / SECOND
        self.advance(stamp / SECOND)

    def _open(self, topics: list[str], start: int) -> None:
        self._messages = self._bag.messages(topics, start) if topics else iter(())
        self._step()

    def _reopen(self) -> None:
        """Look whether the bag has grown."""
        try:
            bag = self._open_bag()
        except AgvMotionError:
            return  # it is being renamed or moved just now
        self._bag.close()
        self._bag = bag
        self._meet_robots()
        self._open(self._topics(), int(self.at * SECOND))

    def _step(self) -> None:
        """Go to the next message; one that is damaged ends what can be seen."""
        try:
            self._next = next(self._messages, None)
        except AgvMotionError:
            self._next = None

    def _take(self, message: Message) -> None:
        known = split(message.connection.topic)
        decode = self._decoder(message.connection)
        if known is not None and decode is not None:
            self.board.receive(*known, message.stamp / SECOND, message, decode)

    def _decoder(self, connection: Connection) -> MessageDecoder | None:
        key = connection.topic, connection.definition
        if key not in self._decoders:
            try:
                self._decoders[key] = MessageDecoder(connection, self._bag.path)
            except AgvMotionError:
                self._decoders[key] = None
        return self._decoders[key]
