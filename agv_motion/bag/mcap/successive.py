"""Small chunks that follow each other in time are read like a large one: recordings have many."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.chunk import heads
from agv_motion.bag.mcap.time_order import Run, inside

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.connection import Message
    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.file import Entries
    from agv_motion.bag.mcap.record_parsing import Buffer

    Open = Callable[[Chunk], tuple[Buffer, Mapping[int, Entries]]]
    Read = Callable[[bytes, list[int]], Iterator[Message]]

_LARGEST = 1 << 20
"""[bytes] Chunks are read together up to this size."""


def successive(chunks: Iterable[Chunk]) -> Iterator[list[Chunk]]:
    """Yield chunks in the order of their start; together those that overlap no other before."""
    group: list[Chunk] = []
    size, latest, others = 0, -1, -1
    for chunk in sorted(chunks, key=lambda chunk: chunk.start):
        size += chunk.size
        follows = chunk.start >= latest and chunk.start > others  # else equal stamps change places
        follows = follows and bool(group) and chunk.offset > group[-1].offset
        if group and not (follows and size <= _LARGEST):
            yield group
            group, size, others = [], chunk.size, latest
        group.append(chunk)
        latest = max(latest, chunk.end)
    if group:
        yield group


def joined(
    group: Sequence[Chunk], unpack: Open, read: Read, channels: Sequence[int], span: range
) -> Run | None:
    """Return the messages of successive chunks; None if something is amiss in one of them.

    Args:
        group: The chunks.
        unpack: Returns content and entries of one.
        read: Yields the messages at some offsets of a content.
        channels: Ids of those that are described in the file.
        span: [ns] log times.

    """
    contents: list[Buffer] = []
    stamps: list[NDArray[Any]] = []
    offsets: list[NDArray[Any]] = []
    told, counts, ends, size = [], [], [], 0
    try:
        for chunk in group:
            content, found = unpack(chunk)
            contents.append(content)
            for channel, entries in found.items():
                told.append(channel)
                stamps.append(entries.stamps)
                offsets.append(entries.offsets.astype(np.uint64) + np.uint64(size))
                counts.append(len(entries.stamps))
                ends.append(size + len(content))
            size += len(content)
        if not stamps:
            return Run([], lambda *_: iter(()))
        data, times, places = b''.join(contents), np.concatenate(stamps), np.concatenate(offsets)
        lie = heads(data, places)
    except (DamagedBagError, ValueError):
        return None
    size_of = lie['length'] + np.uint64(records.PREFIX.size)
    beyond = places + size_of > np.repeat(np.array(ends, np.uint64), counts)
    if beyond.any() or not np.isin(lie['channel'], channels).all():
        return None
    if (lie['channel'] != np.repeat(told, counts)).any() or (lie['stamp'] != times).any():
        return None
    wanted = inside(times, span.start, span.stop)
    times, places = times[wanted], places[wanted]
    order = np.lexsort((places, times))
    sorted_places = places[order].tolist()
    return Run(times[order].tolist(), lambda a, b: read(data, sorted_places[a:b]))
