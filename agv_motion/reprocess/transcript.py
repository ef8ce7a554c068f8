"""What the nodes of an `InProcessGraph` say, written into a bag."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.ros.endpoints import offer
from agv_motion.ros.in_process_topic import InProcessEnd, InProcessRowPublisher
from agv_motion.ros.messages import type_name
from agv_motion.ros.row_table import Table

if TYPE_CHECKING:
    from agv_motion.bag.writer import BagWriter

TOGETHER = 1024
"""Messages that are looked at, and written, together."""


class Transcript:
    """What the nodes of a graph say, in a bag; each topic begins with its first message.

    Messages are written many together: `flush` when the last has come.
    """

    def __init__(self, writer: BagWriter) -> None:
        """Start with no topic."""
        self.messages = 0
        self._writer = writer
        self._topics: dict[str, int] = {}
        self._tables: dict[InProcessRowPublisher, Table] = {}
        self._waiting: list[tuple[InProcessEnd, int, Any]] = []

    def record(self, publisher: InProcessEnd, stamp: int, data: Any) -> None:
        """Take a message, or a row, of time ``stamp`` [ns]."""
        self._waiting.append((publisher, stamp, data))
        if len(self._waiting) >= TOGETHER:
            self.flush()

    def flush(self) -> None:
        """Hand what has come to the writer."""
        if not self._waiting:
            return
        publishers, stamps, found = zip(*self._waiting, strict=True)
        topics = {publisher: self._topic(publisher) for publisher in dict.fromkeys(publishers)}
        rows: dict[InProcessEnd, list[int]] = {}
        for i, (publisher, data) in enumerate(zip(publishers, found, strict=True)):
            if type(data) is not bytes:
                rows.setdefault(publisher, []).append(i)
        messages = list(found)
        for publisher, places in rows.items():
            assert isinstance(publisher, InProcessRowPublisher)
            times = np.array([stamps[i] for i in places], np.int64)
            made = self._table(publisher).messages(times, [found[i].row for i in places])
            for i, message in zip(places, made, strict=True):
                messages[i] = message
        self._writer.write_several([topics[one] for one in publishers], stamps, messages)
        self.messages += len(messages)
        self._waiting.clear()

    def _table(self, publisher: InProcessRowPublisher) -> Table:
        """Return what makes messages of many rows together."""
        if publisher not in self._tables:
            self._tables[publisher] = Table(publisher.rows)
        return self._tables[publisher]

    def _topic(self, publisher: InProcessEnd) -> int:
        if publisher.topic not in self._topics:
            self._topics[publisher.topic] = self._add(publisher)
        return self._topics[publisher.topic]

    def _add(self, publisher: InProcessEnd) -> int:
        kind, qos = type_name(publisher.kind), [offer(publisher.qos)]
        return self._writer.add_topic(publisher.topic, kind, qos=qos)
