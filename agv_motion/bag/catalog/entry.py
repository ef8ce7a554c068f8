"""What an index tells of a bag, read from its summary: no chunk is unpacked."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.catalog.discovery import size
from agv_motion.bag.reader import BagReader
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.chunked_file import ChunkedFile

LOOKED_AT = 64
"""chunks of a file by which the sizes of messages are judged"""


class TopicEntry(NamedTuple):
    """A topic of a bag, and one of its types: one that changed its type has several."""

    name: str
    type: str
    messages: int
    size: float | None
    """[bytes] of its messages, about; None: unknown"""


class BagEntry(NamedTuple):
    """A bag."""

    start: int = 0
    """[ns] log time of the first message; 0 without messages"""
    end: int = 0
    """[ns] log time of the last message"""
    messages: int = 0
    size: int = 0
    """[bytes] of its files"""
    fault: str = ''
    """what is wrong with it, or why it cannot be read; empty: nothing that is known"""
    topics: tuple[TopicEntry, ...] = ()


def entry_of(path: Path) -> BagEntry:
    """Return what is in a bag; a damaged one has a fault, and what could be read all the same."""
    stored = 0
    try:
        stored = size(path)
        with BagReader(path) as bag:
            sizes = _sizes(bag)
            counts: Counter[tuple[str, str]] = Counter()
            for connection, count in bag.connection_counts.items():
                counts[connection[:2]] += count
            topics = tuple(TopicEntry(*one, n, sizes.get(one)) for one, n in counts.items())
            wrong = [str(p) for p in bag.problems if not getattr(p, 'harmless', False)]
            more = f' (and {len(wrong) - 1} more)' if len(wrong) > 1 else ''
            fault = wrong[0] + more if wrong else ''
            return BagEntry(bag.start, bag.end, bag.message_count, stored, fault, topics)
    except (AgvMotionError, OSError) as error:
        return BagEntry(size=stored, fault=str(error))


class ReadBag(NamedTuple):
    """What another process has read."""

    source: str
    entry: BagEntry | None
    """None: the process has died over it"""


class EntryReading:
    """Reads bags in other processes; see :class:`agv_motion.ros.many_bags.Work`."""

    def run(
        self, source: Path, target: Path, tell: Callable[[float], None] | None = None
    ) -> ReadBag:
        """Return what is in a bag."""
        del target, tell
        return ReadBag(str(source), entry_of(source))

    def modules(self) -> tuple[str, ...]:
        """Return nothing: all that is needed is imported with this module."""
        return ()

    def apart(self) -> bool:
        """Return that it may be done in any process."""
        return False

    def lost(self, source: Path, reason: str) -> ReadBag:
        """Return that nothing is known of a bag."""
        del reason
        return ReadBag(str(source), None)


def _sizes(bag: BagReader) -> dict[tuple[str, str], float]:
    """Return the bytes of each topic and type: the mean over some chunks, times its messages."""
    found: dict[tuple[str, str], float] = {}
    for file in bag.files:
        chunks = file.as_chunks()
        if chunks is None or not file.indexed:
            return {}
        for channel, mean in _means(chunks).items():
            if channel in file.channels:
                one = file.channels[channel][:2]
                found[one] = found.get(one, 0.0) + mean * file.counts().get(channel, 0)
    return found


def _means(file: ChunkedFile) -> dict[int, float]:
    """Return the mean size of the messages of each channel, in some of the chunks [bytes]."""
    sizes: dict[int, list[float]] = {}
    for chunk in _some(file.chunks):
        told = file.entries(chunk)
        places = sorted((int(o), n) for n, one in told.items() for o in one.offsets)
        ends = [offset for offset, _ in places[1:]] + [chunk.size]
        for (offset, channel), end in zip(places, ends, strict=True):
            sums = sizes.setdefault(channel, [0.0, 0.0])
            sums[0] += end - offset
            sums[1] += 1
    return {channel: total / count for channel, (total, count) in sizes.items()}


def _some(chunks: Iterable[Chunk]) -> list[Chunk]:
    """Return chunks from everywhere in a file, and for each channel one that it is in."""
    every = [chunk for chunk in chunks if chunk.filled]
    step = max(-(-len(every) // LOOKED_AT), 1)
    some, rest = every[::step], []
    known = {channel for chunk in some for channel in chunk.indexes or ()}
    for chunk in every:
        new = set(chunk.indexes or ()) - known
        if new:
            known |= new
            rest.append(chunk)
    return some + rest
