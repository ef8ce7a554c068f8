"""What the nodes of an `InProcessGraph` say, written into a bag."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.recording.recorded_transforms import RecordedTransforms
from agv_motion.model.transform_message import TF, TF_STATIC
from agv_motion.ros.endpoints import offer
from agv_motion.ros.in_process_topic import InProcessEnd, InProcessRowPublisher
from agv_motion.ros.messages import type_name
from agv_motion.ros.row_table import Table

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.bag.writer import BagWriter

TOGETHER = 1024
"""Messages that are looked at, and written, together."""
PLACES = '/odom', '/pose'
"""Topics that tell where a robot is: without a new one there are no new transforms"""


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
        self._waiting: list[tuple[InProcessEnd | str, int, Any]] = []
        """a name stands for a message of the recording, which is not written again"""
        self._heard: deque[tuple[str, int, bytes]] = deque()
        self._moves: RecordedTransforms | None = None
        self._moving: set[str] = set()

    def make_transforms(self, published: Mapping[str, str], heard: Mapping[str, str]) -> set[str]:
        """Write `/tf` and `/tf_static`, too, as a recorder does, of what follows from now on.

        Args:
            published: Topics of the nodes, and their types.
            heard: Topics of the recording, and theirs.

        Returns:
            Those of the recording that are needed, for `hear`; none where no transforms follow.

        """
        moves = RecordedTransforms(self._add_transforms)
        made = {topic for topic, kind in published.items() if moves.wants(topic, kind)}
        if not any(topic.endswith(PLACES) for topic in made):
            return set()
        self._moves = moves
        self._moving = made | {topic for topic, kind in heard.items() if moves.wants(topic, kind)}
        return self._moving - made

    def record(self, publisher: InProcessEnd, stamp: int, data: Any) -> None:
        """Take a message, or a row, of time ``stamp`` [ns].

        Transforms of nodes are left out, which only some installations can publish: what is written
        is the same everywhere.
        """
        if publisher.topic in {TF, TF_STATIC}:
            return
        while self._heard and self._heard[0][1] <= stamp:
            self._waiting.append(self._heard.popleft())
        self._waiting.append((publisher, stamp, data))
        if len(self._waiting) >= TOGETHER:
            self.flush()

    def hear(self, topic: str, stamp: int, data: bytes) -> None:
        """Take a message of the recording from which transforms follow, in its turn."""
        self._heard.append((topic, stamp, data))

    def end(self, stamp: int) -> None:
        """Write what is left, at the end of the recording [ns]."""
        self._waiting += self._heard
        self.flush()
        if self._moves is not None:
            self._write([(handle, stamp, data) for handle, data in self._moves.last()])

    def flush(self) -> None:
        """Hand what has come to the writer."""
        waiting, self._waiting = self._waiting, []
        rows: dict[InProcessRowPublisher, list[int]] = {}
        for i, (publisher, _, data) in enumerate(waiting):
            if type(data) is not bytes:
                assert isinstance(publisher, InProcessRowPublisher)
                rows.setdefault(publisher, []).append(i)
        messages = [data for _, _, data in waiting]
        for publisher, places in rows.items():
            times = np.array([waiting[i][1] for i in places], np.int64)
            made = self._table(publisher).messages(times, [messages[i].row for i in places])
            for i, message in zip(places, made, strict=True):
                messages[i] = message
        found: list[tuple[int, int, bytes]] = []
        for (publisher, stamp, _), message in zip(waiting, messages, strict=True):
            if isinstance(publisher, str):
                name = publisher
            else:
                name = publisher.topic
                found.append((self._topic(publisher), stamp, message))
            if self._moves is not None and name in self._moving:
                told = self._moves.take(name, message)
                found += [(handle, stamp, data) for handle, data in told]
        self._write(found)

    def _write(self, found: Sequence[tuple[int, int, bytes]]) -> None:
        """Write messages: the handle of the topic, the time [ns] and the bytes of each."""
        if found:
            self._writer.write_several(*zip(*found, strict=True))
            self.messages += len(found)

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

    def _add_transforms(self, topic: str, kind: str, qos: Sequence[OfferedQos]) -> int:
        return self._writer.add_topic(topic, kind, qos=qos)
