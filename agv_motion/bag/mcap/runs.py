"""Chunks as runs of messages, each opened when its time has come and compared with its index.

Small chunks that follow each other in time are read like a large one: recordings have many.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.time_order import Run, inside

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.connection import Message
    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.chunked_file import ChunkedFile, Entries
    from agv_motion.bag.mcap.record_parsing import Buffer

_LARGEST = 1 << 20
"""[bytes] Chunks are read together up to this size."""


def runs(
    file: ChunkedFile, wanted: frozenset[int], span: range
) -> Iterator[tuple[int, int, Callable[[], Run | None]]]:
    """Yield earliest stamp, place and opener of runs, in the order of their stamps.

    Args:
        file: Whose chunks.
        wanted: Ids of channels.
        span: [ns] log times.

    """
    start, stop = span.start, span.stop
    chunks = [
        c for c in file.chunks
        if c.filled and c.end >= start and c.start < stop
        and (c.indexes is None or not wanted.isdisjoint(c.indexes))
    ]  # fmt: skip
    for group in successive(chunks):
        run = _together(file, group, wanted, span) if group[1:] else None
        if run is not None:
            yield group[0].start, group[0].offset, partial(Run, *run)
            continue
        for chunk in group:
            yield chunk.start, chunk.offset, partial(_alone, file, chunk, wanted, span)


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


def _together(
    file: ChunkedFile, group: Sequence[Chunk], wanted: frozenset[int], span: range
) -> Run | None:
    """Return the messages of successive chunks; None if something is amiss in one of them."""
    try:
        contents = [file.unpacked(chunk) for chunk in group]
        told = [
            file.entries(chunk, content, wanted)
            for chunk, content in zip(group, contents, strict=True)
        ]
        data = b''.join(contents)
        found = _sorted(file, group[0], data, _listed(told, [len(c) for c in contents]), span)
        file.release(group[0].offset, group[-1].offset + group[-1].length)
    except DamagedBagError:
        return None
    if found is None:
        return Run([], lambda *_: iter(()))
    stamps, places = found
    return Run(stamps, lambda a, b: file.messages_at(data, places[a:b]))


def _alone(file: ChunkedFile, chunk: Chunk, wanted: frozenset[int], span: range) -> Run | None:
    """Return the messages of one chunk, which is unpacked again if it waits too long.

    Raises:
        DamagedBagError: It is damaged, or its index tells of other messages than are in it.

    """
    told = file.entries(chunk, wanted=wanted)
    if not told:
        return None
    content = file.content(chunk)
    found = _sorted(file, chunk, content, _listed([told], [len(content)]), span)
    del content  # the run holds no chunk: it asks for it again
    file.release_chunk(chunk)
    if found is None:
        return None
    stamps, places = found

    def messages(first: int, last: int) -> Iterator[Message]:
        yield from file.messages_at(file.content(chunk), places[first:last])
        if last == len(places):
            file.forget(chunk)

    return Run(stamps, messages)


class _Listed(NamedTuple):
    """What the indexes of some chunks, whose contents follow each other, tell of each message."""

    channels: NDArray[Any]
    stamps: NDArray[Any]
    """[ns]"""
    places: NDArray[np.uint64]
    """[bytes] in the contents"""
    ends: NDArray[np.uint64]
    """[bytes] where the content ends that it lies in"""


def _listed(told: Sequence[Mapping[int, Entries]], sizes: Sequence[int]) -> _Listed | None:
    """Return the entries of some chunks, whose contents have ``sizes`` [bytes]; None without."""
    entries = [one for by_channel in told for one in by_channel.values()]
    if not entries:
        return None
    counts = [len(one.stamps) for one in entries]
    ends = np.repeat(np.cumsum(sizes, dtype=np.uint64), [len(by_channel) for by_channel in told])
    room = np.repeat(np.array(sizes, np.uint64), [len(by_channel) for by_channel in told])
    ends, room = np.repeat(ends, counts), np.repeat(room, counts)
    offsets = np.concatenate([one.offsets for one in entries])
    return _Listed(
        np.repeat([channel for by_channel in told for channel in by_channel], counts),
        np.concatenate([one.stamps for one in entries]),
        # no further than the end of the content, where no message is: the sum cannot wrap
        np.minimum(offsets, room) + (ends - room),
        ends,
    )


def _sorted(
    file: ChunkedFile, chunk: Chunk, content: Buffer, listed: _Listed | None, span: range
) -> tuple[list[int], list[int]] | None:
    """Return log times [ns] and places of the messages in a span, in the order of time.

    Raises:
        DamagedBagError: They are not where they are listed; ``chunk`` is named.

    """
    if listed is None:
        return None
    lie = file.heads(chunk, content, listed.places)
    wrong = (lie['channel'] != listed.channels) | (lie['stamp'] != listed.stamps)
    wrong |= listed.places + lie['length'] + np.uint64(records.PREFIX.size) > listed.ends
    if wrong.any():
        file.require_described(chunk, lie)
        finding = 'in this chunk, messages that are not those of its index'
        raise DamagedBagError(file.path, chunk.offset, finding)
    wanted = inside(listed.stamps, span.start, span.stop)
    stamps, places = listed.stamps[wanted], listed.places[wanted]
    order = np.lexsort((places, stamps))
    return stamps[order].tolist(), places[order].tolist()
