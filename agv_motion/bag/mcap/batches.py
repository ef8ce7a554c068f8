"""The messages of an MCAP file, unpacked and handed over by several threads, in their order."""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.mcap import chunk_batches
from agv_motion.bag.threads import threads

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from numpy.typing import NDArray

    from agv_motion.bag.columns.batch import Batch
    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.chunked_file import ChunkedFile

    Turns = dict[str, Future[None]]
    """done when the messages of a topic in some chunks were handed over"""

_FREED = 1 << 24
"""[bytes] glibc gives memory back beyond twice the largest block that was ever freed, and takes it
again page by page: with this one, arrays that come and go keep their pages."""


def read_mcap(
    file: ChunkedFile,
    channels: Collection[int],
    start: int,
    stop: int,
    put: Callable[[Batch], None],
) -> None:
    """Hand over the messages of an MCAP file as they lie in it, some chunks together.

    Each thread unpacks chunks and hands over what it then has in its cache, topic by topic, as
    soon as all that lies before on this topic was handed over.

    Args:
        file: The file.
        channels: Their ids.
        start: [ns] first log time.
        stop: [ns] log time before which to stop.
        put: Takes messages of one channel; called by several threads, for a topic by one at once.

    Raises:
        DamagedBagError: A chunk is damaged.

    """
    np.empty(_FREED, np.uint8)  # nothing is written there, so it costs nothing
    reading = _Reading(file, sorted(channels), (start, stop), put)
    groups = chunk_batches.groups(
        chunk
        for chunk in file.chunks
        if chunk.end >= start
        and chunk.start < stop
        and (chunk.indexes is None or not chunk.indexes.keys().isdisjoint(channels))
    )
    turns = reading.turns()
    for turn in turns.values():
        turn.set_result(None)
    with ThreadPoolExecutor(at_once := threads()) as pool:
        waiting: deque[Future[None]] = deque()
        for group in groups:
            before, turns = turns, reading.turns()
            waiting.append(pool.submit(reading.give, group, before, turns))
            if len(waiting) > at_once:
                waiting.popleft().result()
        while waiting:
            waiting.popleft().result()


class _Reading:
    """What the threads that read a file have in common."""

    def __init__(
        self,
        file: ChunkedFile,
        channels: list[int],
        span: tuple[int, int],
        put: Callable[[Batch], None],
    ) -> None:
        self._file, self._channels, self._span, self._put = file, channels, span, put
        self._topics = {number: file.channels[number].topic for number in channels}
        self._buffers: list[NDArray[np.uint8]] = []

    def turns(self) -> Turns:
        """Return what is to be done for each topic."""
        return {topic: Future() for topic in self._topics.values()}

    def give(self, chunks: list[Chunk], before: Turns, mine: Turns) -> None:
        """Unpack chunks and hand over their messages, those of each topic when it is its turn."""
        try:
            self._give(chunks, before, mine)
        except BaseException as error:
            for turn in mine.values():
                if not turn.done():
                    turn.set_exception(error)  # nobody waits for ever
            raise
        self._file.release(chunks[0].offset, chunks[-1].offset + chunks[-1].length)

    def _give(self, chunks: list[Chunk], before: Turns, mine: Turns) -> None:
        buffer = self._buffers.pop() if self._buffers else np.empty(chunk_batches.GROUP, np.uint8)
        together = chunk_batches.unpacked(self._file, chunks, buffer.data)
        found = chunk_batches.batches(self._file, together, self._channels, *self._span)
        for topic, turn in mine.items():
            before[topic].result()
            for batch in found:
                if self._topics[batch.channel] == topic:
                    self._put(batch)
            turn.set_result(None)
        self._buffers.append(buffer)
