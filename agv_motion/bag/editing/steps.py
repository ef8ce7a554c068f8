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
from agv_motion.bag.editing.blocks import blocks_ahead
from agv_motion.bag.editing.picking import Picked, Wanted, pick
from agv_motion.bag.mcap.message_heads import HEAD, headed
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
    """Yield steps that make chunks of messages, which are read one step ahead."""
    for block in blocks_ahead(messages, CHUNK):
        size = sum(len(message.data) + HEAD.itemsize for message in block)
        work = partial(together, block, ids)
        yield Step(block[0].stamp, 2 * size, size, work, lambda: None)


def together(messages: Sequence[Message], ids: Mapping[Connection, int]) -> Picked:
    """Return messages as they are to lie in a chunk.

    Raises:
        SignalError: A number does not fit its field.

    """
    connections, stamps, data, publishes, sequences = zip(*messages, strict=True)
    for times, what in ((stamps, 'log'), (publishes, 'publish')):
        if not 0 <= min(times) <= max(times) < 2**64:
            msg = (
                f'{what} times from {min(times)} to {max(times)}: expected nanoseconds in [0, 2^64)'
            )
            raise SignalError(msg)
    heads = np.zeros(len(data), HEAD)
    heads['channel'] = [ids[connection] for connection in connections]
    heads['stamp'], heads['publish'] = np.array(stamps, np.uint64), np.array(publishes, np.uint64)
    heads['sequence'] = [sequence & 0xFFFFFFFF for sequence in sequences]
    parts, offsets = headed(heads, data)
    return Picked(b''.join(parts), heads['channel'].copy(), heads['stamp'].copy(), offsets)
