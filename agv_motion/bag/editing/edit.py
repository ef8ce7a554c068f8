"""A bag out of bags: cut, filtered, merged, split, compressed, put in order: one engine for all.

with BagReader('walk') as bag:
    edit([bag], Path('odom'), Edit(topics=Selection(topics=('/odom',))))

Chunks are copied whole where they can be, and only the others rewritten, in several threads; their
order stays. Whatever is read is compared with its CRC. What is damaged is an error: an edit never
leaves anything out in silence.
"""

from __future__ import annotations

import os
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from agv_motion.bag.editing.edited_bags import EditReport, extras, require_sound
from agv_motion.bag.editing.latched import latched_before
from agv_motion.bag.editing.new_bag import NewBag
from agv_motion.bag.editing.new_channels import NewChannels
from agv_motion.bag.editing.picking import Picked, Wanted, joined
from agv_motion.bag.editing.steps import CHUNK, EditSource, Step, ids_of, plan, stream
from agv_motion.bag.mcap import record_parsing
from agv_motion.bag.mcap.chunk_content import stored_content
from agv_motion.bag.selection import Selection
from agv_motion.bag.threads import threads

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from agv_motion.bag.mcap.output import NewChunk
    from agv_motion.bag.mcap.records import Metadata
    from agv_motion.bag.reader import BagReader

    Span = tuple[int, int]

_AHEAD = 1 << 25
"""[bytes] that steps may have in memory before they are written"""
EVERYTHING = Selection(everything=True, hidden=True)


@dataclass(frozen=True)
class Edit:
    """What is to become of some bags; the default copies them into one."""

    topics: Selection = EVERYTHING
    spans: tuple[Span, ...] | None = None
    """[ns] first log times, and those before which to stop, in order and apart; None: all"""
    latched: bool = False
    """whether each span begins with what latched topics had told before it"""
    compression: str | None = None
    """of the chunks: 'zstd', 'lz4' or ''; None: as they are"""
    ordered: bool = False
    """whether messages are put in the order of their log time"""
    parts: tuple[Span, ...] = ()
    """[ns] each goes into a file of its own"""
    file_size: int = 0
    """[bytes] after which a new file begins; 0: never"""
    record: Metadata | None = None
    """named strings that the new bag has besides"""


def edit(
    bags: Sequence[BagReader],
    folder: Path,
    what: Edit,
    progress: Callable[[float], None] = lambda _: None,
) -> EditReport:
    """Make a bag.

    Args:
        bags: Open; where they overlap in time, chunks take turns.
        folder: Of the new bag; it must not exist.
        what: What is to become of them.
        progress: Is told the share that is done.

    Raises:
        DamagedBagError: Something that is wanted is damaged.
        SourceError: A bag cannot be read.
        OSError: The disk takes no more.

    """
    require_sound(bags, whole=what.spans is None)
    channels = NewChannels()
    sources = [source for bag in bags for source in _sources(bag, what, channels)]
    new = NewBag(folder, channels, _profile(bags))
    try:
        for extra in (*extras(bags), *([what.record] if what.record else [])):
            new.keep(extra)
        work = EditWork(new, fill_of(sources, what), what.file_size)
        total = sum(os.path.getsize(source.file.path) for source in sources)  # noqa: PTH202

        def show(read: int) -> None:
            progress(min(read / total, 1.0))

        for spans in _files(what):
            if spans != ():
                work.do(_steps(bags, sources, spans, what), show)
                new.next_file()
        new.close()
    except BaseException:
        with suppress(OSError):
            new.abandon()
        raise
    return EditReport(new.messages, work.copied, work.made, new.file_count)


def fill_of(sources: Iterable[EditSource], what: Edit) -> str:
    """Return the compression of new chunks: what is asked for, or that of the first chunk."""
    if what.compression is not None:
        return what.compression
    for source in sources:
        for chunk in source.chunks.chunks if source.chunks else ():
            if not chunk.bare:
                assert source.chunks is not None
                return stored_content(source.chunks.data, chunk, source.file.path)[0].compression
    return 'zstd'


class EditWork:
    """Does steps, in threads, and writes what comes of them in their order."""

    def __init__(self, new: NewBag, compression: str, file_size: int) -> None:
        """Write into a new bag; files end at a size of ``file_size`` [bytes], 0: never."""
        self.copied = self.made = 0
        self._new, self._compression, self._file_size = new, compression, file_size
        self._pile: list[Picked] = []
        self._read = 0

    def do(self, steps: Iterator[Step], show: Callable[[int], None]) -> None:
        """Do all steps."""
        waiting: deque[tuple[Step, Future[NewChunk | Picked | None]]] = deque()
        ahead = 0
        with ThreadPoolExecutor(threads()) as pool:
            try:
                for step in steps:
                    while waiting and ahead + step.size > _AHEAD:
                        ahead -= self._settle(*waiting.popleft())
                        show(self._read)
                    waiting.append((step, pool.submit(self._done, step)))
                    ahead += step.size
                while waiting:
                    self._settle(*waiting.popleft())
                    show(self._read)
            finally:
                pool.shutdown(cancel_futures=True)
        self._flush()

    def _done(self, step: Step) -> NewChunk | Picked | None:
        """Do a step; what is large enough for a chunk becomes one."""
        found = step.work()
        if isinstance(found, Picked) and 2 * len(found.content) >= CHUNK:
            return found.packed(self._compression)
        return found

    def _settle(self, step: Step, coming: Future[NewChunk | Picked | None]) -> int:
        """Write what came of a step; return its size."""
        found = coming.result()
        if isinstance(found, Picked):
            self._pile.append(found)
            if sum(len(part.content) for part in self._pile) >= CHUNK:
                self._flush()
        elif found is not None:
            self._flush()
            self._put(found)
        self._read += step.read
        step.done()
        return step.size

    def _flush(self) -> None:
        """Make a chunk of the messages that are on the pile."""
        if self._pile:
            pile, self._pile = self._pile, []
            self._put(joined(pile).packed(self._compression))

    def _put(self, chunk: NewChunk) -> None:
        self.made += chunk.fresh
        self.copied += not chunk.fresh
        self._new.put(chunk)
        if 0 < self._file_size <= self._new.file_size:
            self._new.next_file()


def _sources(bag: BagReader, what: Edit, channels: NewChannels) -> Iterator[EditSource]:
    for file in bag.files:
        wanted = [n for n, c in file.channels.items() if what.topics.takes(c.topic)]
        ids = channels.add(file, wanted)
        taken = Wanted(ids.ids, what.spans, what.compression, what.ordered, ids.foreign)
        yield EditSource(file, taken, bag.messages_compressed)


def _steps(
    bags: Sequence[BagReader],
    sources: Sequence[EditSource],
    spans: tuple[Span, ...] | None,
    what: Edit,
) -> Iterator[Step]:
    """Yield the steps for one file of the new bag."""
    if spans is None or not what.latched:
        yield from plan(_within(sources, spans), ordered=what.ordered)
        return
    known = 0
    for start, stop in spans:
        told = latched_before(bags, what.topics, start, known)
        yield from stream(told, ids_of(sources))
        yield from plan(_within(sources, ((start, stop),)), ordered=what.ordered)
        known = stop


def _within(sources: Iterable[EditSource], spans: tuple[Span, ...] | None) -> list[EditSource]:
    return [source._replace(wanted=source.wanted._replace(spans=spans)) for source in sources]


def _files(what: Edit) -> Iterator[tuple[Span, ...] | None]:
    """Yield the spans of each file of the new bag; None means all."""
    if not what.parts:
        yield what.spans
    for start, stop in what.parts:
        both = [(max(a, start), min(b, stop)) for a, b in what.spans or ((start, stop),)]
        yield tuple((a, b) for a, b in both if a < b)


def _profile(bags: Sequence[BagReader]) -> str:
    """Return what the first bag says that its messages are."""
    chunks = bags[0].files[0].as_chunks()
    return 'ros2' if chunks is None else record_parsing.profile(chunks.data, chunks.path)
