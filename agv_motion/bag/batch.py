"""Messages of one channel that lie in one buffer: what columns are decoded from."""

from __future__ import annotations

from bisect import bisect_right
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag import records
from agv_motion.bag.chunk import HEAD, LARGEST, heads
from agv_motion.bag.compression import decompress_message
from agv_motion.bag.damage import DamagedBagError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.chunk import Chunk
    from agv_motion.bag.connection import Message
    from agv_motion.bag.mcap_file import McapFile
    from agv_motion.bag.record_parsing import Buffer
    from agv_motion.bag.sqlite_file import SqliteFile

ENCAPSULATION = 4
"""[bytes] before the content of a message: how it is written"""
_HEAD = np.dtype([*((n, HEAD[n]) for n in HEAD.names or ()), ('form', '>u2'), ('options', '>u2')])
_GROUP = 1 << 23
"""[bytes] Chunks are decoded together up to this size."""
_THREADS = 2
"""Decoding, one at a time, takes as long as unpacking by one of them."""
_FREED = 1 << 24
"""[bytes] glibc gives memory back beyond twice the largest block that was ever freed, and takes it
again page by page: with this one, arrays that come and go keep their pages."""
_LATEST = 2**64 - 1
_TOGETHER = 2048
"""Messages that are taken together where there are no chunks."""
_MOST = 1 << 24
"""[bytes] ... and their size."""


class Batch(NamedTuple):
    """Some messages of one channel."""

    channel: int
    data: Buffer
    starts: NDArray[np.int64]
    """[bytes] in ``data`` where the content of each begins, behind the encapsulation"""
    sizes: NDArray[np.int64]
    """[bytes] of each content"""
    forms: NDArray[Any]
    """encapsulation of each: 0 for big-endian, 1 for little-endian CDR"""
    stamps: NDArray[np.int64]
    """[ns] log time of each"""
    path: Path
    origins: Sequence[tuple[int, int]]
    """where ``data`` comes from, for errors: pairs of a place in it [bytes] and one in the file"""

    def origin(self, row: int) -> int:
        """Return the place in the file where a message comes from [bytes]."""
        return _origin(self.origins, int(self.starts[row]))

    def part(self, rows: slice) -> Batch:
        """Return some of the messages."""
        return self._replace(
            starts=self.starts[rows],
            sizes=self.sizes[rows],
            forms=self.forms[rows],
            stamps=self.stamps[rows],
        )


class _Together(NamedTuple):
    """Chunks whose contents lie in one buffer."""

    chunks: Sequence[Chunk]
    data: Buffer
    ends: NDArray[np.int64]
    """[bytes] where the content of each ends"""


def read_mcap(
    file: McapFile,
    channels: Collection[int],
    start: int,
    stop: int,
    put: Callable[[Batch], None],
) -> None:
    """Give the messages of an MCAP file to ``put`` as they lie in it, some chunks together.

    Threads take turns: while one gives what it has unpacked, and has in its cache, the others
    unpack what comes next.

    Args:
        file: The file.
        channels: Their ids.
        start: [ns] first log time.
        stop: [ns] log time before which to stop.
        put: Takes the messages of one channel; never called by two threads at once.

    Raises:
        DamagedBagError: A chunk is damaged.

    """
    np.empty(_FREED, np.uint8)  # nothing is written there, so it costs nothing
    wanted = sorted(channels)
    buffers: list[NDArray[np.uint8]] = []
    given = 0

    def give(chunks: list[Chunk], before: Future[None] | None) -> None:
        buffer = buffers.pop() if buffers else np.empty(_GROUP, np.uint8)
        found = _batches(file, _unpacked(file, chunks, buffer.data), wanted, start, stop)
        if before:
            before.result()
        nonlocal given
        for batch in found:
            put(batch)
        end = chunks[-1].offset + chunks[-1].length
        file.release(given, end)
        given = end
        buffers.append(buffer)

    groups = _groups(
        chunk
        for chunk in file.chunks
        if chunk.end >= start
        and chunk.start < stop
        and (chunk.indexes is None or not chunk.indexes.keys().isdisjoint(channels))
    )
    with ThreadPoolExecutor(_THREADS) as pool:
        waiting: deque[Future[None]] = deque()
        for group in groups:
            waiting.append(pool.submit(give, group, waiting[-1] if waiting else None))
            if len(waiting) > _THREADS:
                waiting.popleft().result()
        while waiting:
            waiting.popleft().result()


def _groups(chunks: Iterable[Chunk]) -> Iterator[list[Chunk]]:
    """Yield chunks that are small enough to be decoded together."""
    group: list[Chunk] = []
    size = 0
    for chunk in chunks:
        if group and size + chunk.size > _GROUP:
            yield group
            group, size = [], 0
        group.append(chunk)
        size += chunk.size
    if group:
        yield group


def _unpacked(file: McapFile, chunks: Sequence[Chunk], buffer: memoryview) -> _Together:
    """Return the contents of some chunks in one buffer: ``buffer``, if it is large enough."""
    if len(chunks) == 1 and chunks[0].size > len(buffer):
        content = file.unpacked(chunks[0])
        return _Together(chunks, content, np.array([len(content)]))
    ends, begin = [], 0
    for chunk in chunks:
        target = buffer[begin : begin + chunk.size]
        content = file.unpacked(chunk, target)
        if len(content) > len(target):
            finding = f'a chunk of {len(content)} bytes, {chunk.size} by its index'
            raise DamagedBagError(file.path, chunk.offset, finding)
        if not isinstance(content, memoryview) or content.obj is not buffer.obj:
            target[: len(content)] = content
        begin += len(content)
        ends.append(begin)
    return _Together(chunks, buffer[:begin], np.array(ends, np.int64))


def _batches(
    file: McapFile, together: _Together, channels: Sequence[int], start: int, stop: int
) -> list[Batch]:
    """Return the messages of each channel, after a look whether they are where the index says."""
    data, ends = together.data, together.ends
    begins = [0, *ends[:-1].tolist()]
    origins = [(begin, chunk.offset) for begin, chunk in zip(begins, together.chunks, strict=True)]
    parts = list(zip(together.chunks, begins, ends.tolist(), strict=True))
    tables = [file.index_of(c, n, data[a:b]) for n in channels for c, a, b in parts]
    counts = [len(table) for table in tables]
    table = np.concatenate(tables)
    stamps, offsets = table[:, 0], np.minimum(table[:, 1], len(data)).astype(np.int64)
    places = offsets + np.repeat(begins * len(channels), counts)
    limits = np.repeat(np.tile(ends, len(channels)), counts)
    numbers = np.repeat(np.array(channels), np.reshape(counts, (len(channels), -1)).sum(axis=1))
    if start > 0 or stop < 1 << 63:
        inside = stamps >= np.uint64(min(start, _LATEST))
        inside &= stamps < np.uint64(min(stop, _LATEST))
        stamps, places = stamps[inside], places[inside]
        limits, numbers = limits[inside], numbers[inside]
    if not len(places):
        return []
    try:
        found = heads(data, places, _HEAD)
    except ValueError as error:
        place = _origin(origins, int(places.min()))
        raise DamagedBagError(file.path, place, f'near this chunk, {error}') from None
    sizes = found['length'].astype(np.int64) - (_HEAD.itemsize - records.PREFIX.size)
    starts = places + _HEAD.itemsize
    wrong = (found['channel'] != numbers) | (found['stamp'] != stamps) | (starts + sizes > limits)
    if wrong.any() or int(sizes.sum()) + len(sizes) * _HEAD.itemsize > len(data):
        row = int(wrong.argmax())
        place = _origin(origins, int(places[row]))
        finding = (
            f'in this chunk, messages that are not those of the index of channel {numbers[row]}'
        )
        raise DamagedBagError(file.path, place, finding)
    times, forms = stamps.astype(np.int64), found['form'].astype(np.uint16)
    bounds = np.searchsorted(numbers, channels, 'left'), np.searchsorted(numbers, channels, 'right')
    return [
        Batch(n, data, starts[a:b], sizes[a:b], forms[a:b], times[a:b], file.path, origins)
        for n, a, b in zip(channels, *bounds, strict=True)
        if b > a
    ]


def _origin(origins: Sequence[tuple[int, int]], place: int) -> int:
    """Return the place in the file of a place in a buffer [bytes]."""
    return origins[max(0, bisect_right(origins, (place, 2**63)) - 1)][1]


def of_messages(
    file: McapFile | SqliteFile,
    channels: Collection[int],
    start: int,
    stop: int,
    *,
    compressed: bool,
) -> Iterator[Batch]:
    """Yield the messages of any file, some together; unpack those that are compressed each."""
    numbers = {connection: channel for channel, connection in file.channels.items()}
    waiting: dict[int, list[Message]] = {channel: [] for channel in channels}
    size = count = 0
    for message in file.messages(channels, start, stop):
        if compressed:
            message = unpack_message(message, file.path)  # noqa: PLW2901 - the same, unpacked
        waiting[numbers[message.connection]].append(message)
        size, count = size + len(message.data), count + 1
        if size > _MOST or count >= _TOGETHER:
            yield from _joined(waiting, file.path)
            size = count = 0
    yield from _joined(waiting, file.path)


def unpack_message(message: Message, path: Path) -> Message:
    """Return a message that rosbag2 compressed by itself, unpacked.

    Raises:
        DamagedBagError: It is damaged.

    """
    try:
        return message._replace(data=decompress_message(message.data, LARGEST))
    except ValueError as error:
        finding = f'a message on {message.connection.topic} at {message.stamp} ns ({error})'
        raise DamagedBagError(path, 0, finding) from None


def _joined(waiting: dict[int, list[Message]], path: Path) -> Iterator[Batch]:
    for channel, messages in waiting.items():
        if not messages:
            continue
        short = next((m for m in messages if len(m.data) < ENCAPSULATION), None)
        if short:
            finding = f'a message on {short.connection.topic} with {len(short.data)} bytes'
            raise DamagedBagError(path, 0, finding)
        data = b''.join(message.data for message in messages)
        sizes = np.array([len(message.data) for message in messages], np.int64)
        starts = np.cumsum(sizes) - sizes
        forms = np.ndarray((len(data) - 1,), '>u2', data, strides=(1,))[starts]
        stamps = np.array([message.stamp for message in messages], np.int64)
        contents = starts + ENCAPSULATION, sizes - ENCAPSULATION
        yield Batch(channel, data, *contents, forms, stamps, path, [(0, 0)])
        messages.clear()
