"""What is to be done to make a bag out of others, one step a chunk: the plan of every edit.

A step takes a chunk as it is, or some of its messages; where a bag has no chunks (sqlite3, messages
that are compressed each), or where messages have to be put in order, it takes messages from a
stream. Steps come in the order in which they are to be written; each can be done in any thread.
"""

from __future__ import annotations

from functools import partial
from heapq import merge
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.columns.message_batches import unpack_message
from agv_motion.bag.editing.picking import Picked, Wanted, pick
from agv_motion.bag.mcap import records
from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.chunked_file import ChunkedFile
    from agv_motion.bag.mcap.output import NewChunk
    from agv_motion.bag.storage import Storage

    Span = tuple[int, int]

CHUNK = 1 << 20
"""[bytes] of a new chunk, about"""
_ALL = (0, 2**64)
_HEAD_BODY = records.MESSAGE_HEAD.size - records.PREFIX.size


class EditSource(NamedTuple):
    """A file, and what is wanted of it."""

    file: Storage
    wanted: Wanted
    packed: bool
    """whether each message is compressed by itself"""

    @property
    def chunks(self) -> ChunkedFile | None:
        """The file, if its chunks can be taken as they are."""
        return None if self.packed else self.file.as_chunks()


class Step(NamedTuple):
    """One piece of work, and what it needs."""

    start: int
    """[ns] log time by which steps of several sources take turns"""
    size: int
    """[bytes] that it has in memory"""
    read: int
    """[bytes] of the source file that it reads"""
    work: Callable[[], NewChunk | Picked | None]
    done: Callable[[], None]
    """to be called when it was written"""


def plan(sources: Sequence[EditSource], *, ordered: bool = False) -> Iterator[Step]:
    """Yield the steps of all sources, in the order of time as far as chunks allow.

    Args:
        sources: The files.
        ordered: Put all messages in the order of their log time.

    """
    if ordered:
        return _ordered(sources)
    return merge(*map(_steps, sources), key=attrgetter('start'))


def _steps(source: EditSource) -> Iterator[Step]:
    """Yield the steps of a file as it lies there."""
    if source.chunks is None:
        yield from stream(_messages(source), ids_of([source]))
        return
    latest = 0
    for chunk in source.chunks.chunks:
        if source.wanted.overlaps(chunk):
            latest = max(latest, chunk.start)  # the order of a file stays as it is
            yield _chunk_step(source.chunks, chunk, source.wanted, latest)


def _chunk_step(file: ChunkedFile, chunk: Chunk, wanted: Wanted, start: int) -> Step:
    work = partial(pick, file, chunk, wanted)
    done = partial(file.release_chunk, chunk)
    return Step(start, chunk.size + chunk.length, chunk.length, work, done)


def _ordered(sources: Sequence[EditSource]) -> Iterator[Step]:
    """Yield steps that put messages in order: a chunk that overlaps no other stays a chunk."""
    if any(source.chunks is None for source in sources):
        yield from _merged(sources, _ALL)
        return
    chunks = [
        (chunk, source, source.chunks)
        for source in sources
        if source.chunks is not None
        for chunk in source.chunks.chunks
        if source.wanted.overlaps(chunk)
    ]
    chunks.sort(key=lambda item: item[0].start)
    first = 0
    while first < len(chunks):
        latest, last = chunks[first][0].end, first + 1
        while last < len(chunks) and chunks[last][0].start <= latest:
            latest = max(latest, chunks[last][0].end)
            last += 1
        chunk, source, file = chunks[first]
        if last - first == 1:
            yield _chunk_step(file, chunk, source.wanted, chunk.start)
        else:
            yield from _merged(sources, (chunk.start, latest + 1))
        first = last


def _merged(sources: Sequence[EditSource], span: Span) -> Iterator[Step]:
    """Yield steps for the messages of all sources in a span, in the order of time."""
    streams = [_messages(source, span) for source in sources]
    yield from stream(merge(*streams, key=attrgetter('stamp')), ids_of(sources))


def _messages(source: EditSource, limits: Span = _ALL) -> Iterator[Message]:
    """Yield the wanted messages of a file in the order of time."""
    for start, stop in source.wanted.spans or (_ALL,):
        span = max(start, limits[0]), min(stop, limits[1])
        for message in source.file.messages(list(source.wanted.channels), *span):
            yield unpack_message(message, source.file.path) if source.packed else message


def ids_of(sources: Iterable[EditSource]) -> dict[Connection, int]:
    """Return the ids in the new file of all channels of some sources."""
    return {
        source.file.channels[old]: new
        for source in sources
        for old, new in source.wanted.channels.items()
    }


def stream(messages: Iterable[Message], ids: Mapping[Connection, int]) -> Iterator[Step]:
    """Yield steps that make chunks of messages, which are read when the step is asked for."""
    block: list[Message] = []
    size = 0
    for message in messages:
        block.append(message)
        size += len(message.data) + records.MESSAGE_HEAD.size
        if size >= CHUNK:
            yield _block_step(block, size, ids)
            block, size = [], 0
    if block:
        yield _block_step(block, size, ids)


def _block_step(block: list[Message], size: int, ids: Mapping[Connection, int]) -> Step:
    work = partial(together, block, ids)
    return Step(block[0].stamp, 2 * size, size, work, lambda: None)


def together(messages: Sequence[Message], ids: Mapping[Connection, int]) -> Picked:
    """Return messages as they are to lie in a chunk.

    Raises:
        SignalError: A number does not fit its field.

    """
    parts, pack = [], records.MESSAGE_HEAD.pack
    channels = [ids[message.connection] for message in messages]
    for (_, stamp, data, publish, sequence), channel in zip(messages, channels, strict=True):
        if not (0 <= stamp < 2**64 and 0 <= publish < 2**64):
            msg = f'log time {stamp}, publish time {publish}: expected nanoseconds in [0, 2^64)'
            raise SignalError(msg)
        head = records.MESSAGE, _HEAD_BODY + len(data), channel, sequence & 0xFFFFFFFF
        parts += [pack(*head, stamp, publish), data]
    sizes = np.array([len(m.data) for m in messages], np.uint64)
    sizes += np.uint64(records.MESSAGE_HEAD.size)
    return Picked(
        b''.join(parts),
        np.array(channels, np.uint16),
        np.array([m.stamp for m in messages], np.uint64),
        np.cumsum(sizes) - sizes,
    )
