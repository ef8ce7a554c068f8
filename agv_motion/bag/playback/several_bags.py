"""Several bags as one: in the order of time, those that overlap merged."""

from __future__ import annotations

from heapq import merge
from itertools import pairwise
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.bag.reader import BagReader
from agv_motion.bag.request import listed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from agv_motion.bag.connection import Connection, Message


class SeveralBags:
    """What a playback asks of a bag, of one or more of them."""

    def __init__(self, paths: Sequence[str | Path]) -> None:
        """Open them all.

        Raises:
            SourceError: One is not there, or cannot be read at all.

        """
        self.bags: list[BagReader] = []
        """in the order of time"""
        try:
            for path in paths:
                self.bags.append(BagReader(path))
        except BaseException:
            self.close()
            raise
        self.bags.sort(key=attrgetter('start'))
        self.path = ', '.join(str(Path(path)) for path in paths)
        self.connections: tuple[Connection, ...] = tuple(
            dict.fromkeys(c for bag in self.bags for c in bag.connections)
        )
        self.topics: dict[str, Connection] = {}
        """the first connection of each topic, by name"""
        for connection in self.connections:
            self.topics.setdefault(connection.topic, connection)

    @property
    def start(self) -> int:
        """Log time of the first message [ns]; 0 without messages."""
        return min((bag.start for bag in self._filled), default=0)

    @property
    def end(self) -> int:
        """Log time of the last message [ns]; 0 without messages."""
        return max((bag.end for bag in self._filled), default=0)

    @property
    def problems(self) -> list[Exception]:
        """What is amiss in any of them, though it can be read."""
        return [problem for bag in self.bags for problem in bag.problems]

    @property
    def lossy(self) -> bool:
        """Whether something that one should hold cannot be read."""
        return any(bag.lossy for bag in self.bags)

    def require(self, topics: Iterable[str]) -> None:
        """Refuse topics that none of them has.

        Raises:
            ConfigurationError: One is not there.

        """
        for topic in topics:
            if topic not in self.topics:
                self.bags[0].require([topic])

    def messages(
        self, topics: Iterable[str] | None = None, start: int | None = None, stop: int | None = None
    ) -> Iterator[Message]:
        """Yield messages of all bags in the order of their log time; see `BagReader.messages`."""
        wanted = None if topics is None else set(listed(topics))
        for group in self._groups():
            streams = [
                bag.messages(None if wanted is None else wanted & bag.topics.keys(), start, stop)
                for bag in group
            ]
            yield from streams[0] if len(streams) == 1 else merge(*streams, key=attrgetter('stamp'))

    def gaps(self) -> list[tuple[int, int]]:
        """Return the times between bags in which nothing was recorded [ns]: last, and next."""
        spans = [(g[0].start, max(bag.end for bag in g)) for g in self._groups()]
        return [(before[1], after[0]) for before, after in pairwise(spans)]

    def close(self) -> None:
        """Let go of the files."""
        for bag in self.bags:
            bag.close()

    @property
    def _filled(self) -> list[BagReader]:
        return [bag for bag in self.bags if bag.topics and bag.message_count]

    def _groups(self) -> Iterator[list[BagReader]]:
        """Yield bags that overlap together, in the order of time."""
        group: list[BagReader] = []
        for bag in self._filled:
            if group and bag.start > max(one.end for one in group):
                yield group
                group = []
            group.append(bag)
        if group:
            yield group
