"""Chunks unpacked into one buffer, and the messages of each channel in it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.columns.batch import Batch
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.message_heads import HEAD, heads
from agv_motion.bag.mcap.time_order import LATEST, inside

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.chunked_file import ChunkedFile
    from agv_motion.bag.mcap.record_parsing import Buffer

GROUP = 1 << 23
"""[bytes] Chunks are decoded together up to this size."""
_HEAD = np.dtype([*((n, HEAD[n]) for n in HEAD.names or ()), ('form', '>u2'), ('options', '>u2')])
_FAR = 2**62
"""[bytes] Farther off than any file is long, and still a number with a sign."""


class BatchesTogether(NamedTuple):
    """Chunks whose contents lie in one buffer."""

    chunks: Sequence[Chunk]
    data: Buffer
    ends: NDArray[np.int64]
    """[bytes] where the content of each ends"""


def groups(chunks: Iterable[Chunk]) -> Iterator[list[Chunk]]:
    """Yield chunks that are small enough to be decoded together."""
    group: list[Chunk] = []
    size = 0
    for chunk in chunks:
        if group and size + chunk.size > GROUP:
            yield group
            group, size = [], 0
        group.append(chunk)
        size += chunk.size
    if group:
        yield group


def unpacked(file: ChunkedFile, chunks: Sequence[Chunk], buffer: memoryview) -> BatchesTogether:
    """Return the contents of some chunks in one buffer: ``buffer``, if it is large enough."""
    if len(chunks) == 1 and chunks[0].size > len(buffer):
        content = file.unpacked(chunks[0])
        return BatchesTogether(chunks, content, np.array([len(content)]))
    ends, begin = [], 0
    for chunk in chunks:
        target = buffer[begin : begin + chunk.size]
        content = file.unpacked(chunk, target)
        if len(content) > len(target):
            finding = f'a chunk of {len(content)} bytes, {chunk.size} by its index'
            raise DamagedBagError(file.path, chunk.offset, finding)
        if memoryview(content).obj is not buffer.obj:
            target[: len(content)] = content
        begin += len(content)
        ends.append(begin)
    return BatchesTogether(chunks, buffer[:begin], np.array(ends, np.int64))


def batches(
    file: ChunkedFile, together: BatchesTogether, channels: Sequence[int], start: int, stop: int
) -> list[Batch]:
    """Return the messages of each channel, after a look whether they are where the index says."""
    data, ends = together.data, together.ends
    begins = [0, *ends[:-1].tolist()]
    origins = [(begin, chunk.offset) for begin, chunk in zip(begins, together.chunks, strict=True)]
    parts = list(zip(together.chunks, begins, ends.tolist(), strict=True))
    tables = [file.index_of(c, n, data[a:b]) for n in channels for c, a, b in parts]
    counts = [len(table) for table in tables]
    table = np.concatenate(tables)
    stamps, offsets = table[:, 0], np.minimum(table[:, 1], _FAR).astype(np.int64)
    places = offsets + np.repeat(begins * len(channels), counts)
    limits = np.repeat(np.tile(ends, len(channels)), counts)
    numbers = np.repeat(
        np.array(channels), np.reshape(counts, (len(channels), len(parts))).sum(axis=1)
    )
    if start > 0 or stop <= LATEST:
        wanted = inside(stamps, start, stop)
        stamps, places = stamps[wanted], places[wanted]
        limits, numbers = limits[wanted], numbers[wanted]
    if not len(places):
        return []
    try:
        found = heads(data, places, _HEAD)
    except ValueError:
        _look_at_each(file, together, places, limits)
        raise
    sizes = found['length'].astype(np.int64) - (_HEAD.itemsize - records.PREFIX.size)
    starts = places + _HEAD.itemsize
    wrong = (found['channel'] != numbers) | (found['stamp'] != stamps) | (starts + sizes > limits)
    spans = sizes + _HEAD.itemsize
    if wrong.any() or int(spans.sum()) > len(data):
        part = np.searchsorted(ends, limits)
        crowded = np.bincount(part, spans, len(ends)) > np.diff(ends, prepend=0)
        row = int((wrong if wrong.any() else crowded[part]).argmax())
        finding = (
            f'in this chunk, messages that are not those of the index of channel {numbers[row]}'
        )
        raise DamagedBagError(file.path, together.chunks[part[row]].offset, finding)
    times, forms = stamps.astype(np.int64), found['form'].astype(np.uint16)
    bounds = np.searchsorted(numbers, channels, 'left'), np.searchsorted(numbers, channels, 'right')
    return [
        Batch(n, data, starts[a:b], sizes[a:b], forms[a:b], times[a:b], file.path, origins)
        for n, a, b in zip(channels, *bounds, strict=True)
        if b > a
    ]


def _look_at_each(
    file: ChunkedFile,
    together: BatchesTogether,
    places: NDArray[np.int64],
    limits: NDArray[np.int64],
) -> None:
    """Raise the damage of the chunk whose index leads to what is no message."""
    begin = 0
    for chunk, end in zip(together.chunks, together.ends.tolist(), strict=True):
        try:
            heads(together.data[begin:end], places[limits == end] - begin, _HEAD)
        except ValueError as error:
            raise DamagedBagError(file.path, chunk.offset, f'in this chunk, {error}') from None
        begin = end
