"""What a person asks of an edit, before a bag is open: times as words, conditions, sizes."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from math import ceil
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.columns.condition import condition
from agv_motion.bag.editing.around import happenings, windows
from agv_motion.bag.editing.edit import EVERYTHING, Edit, edit
from agv_motion.bag.editing.moments import moment
from agv_motion.bag.editing.to_sqlite import edit_to_sqlite
from agv_motion.bag.file_kind import MCAP, SQLITE
from agv_motion.bag.notes import carry
from agv_motion.bag.reader import BagReader
from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.files.unfinished import beside, told

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from agv_motion.bag.editing.edited_bags import EditReport
    from agv_motion.bag.selection import Selection

    Span = tuple[int, int]

SECOND = 10**9
MOST_PARTS = 10_000
"""files of a bag"""


@dataclass(frozen=True)
class EditRequest:
    """What is asked of one bag or of several; the default copies them."""

    topics: Selection = EVERYTHING
    begin: str = ''
    """a moment as of `agv_motion.bag.editing.moments`; empty: the start of the bag"""
    end: str = ''
    """moment before which to stop; empty: never"""
    around: str = ''
    """a condition as of `agv_motion.bag.columns.condition`; empty: none"""
    before: float = 0.0
    """[s] from before it was met"""
    after: float = 0.0
    """[s] to after it was met"""
    latched: bool = False
    """whether what was cut begins with what latched topics had told"""
    compression: str | None = None
    """'zstd', 'lz4', 'none'; None: as it is"""
    ordered: bool = False
    part_duration: float = 0.0
    """[s] of each file; 0: one file"""
    part_size: float = 0.0
    """[MB] of each file, about; 0: one file"""
    storage: str = MCAP
    """'mcap' or 'sqlite3'; empty: the other than that of the bag"""

    def run(
        self, source: Path, target: Path, tell: Callable[[float], None] | None = None
    ) -> EditOutcome:
        """Edit one bag; a failure is part of the outcome."""
        begin = time.perf_counter()
        try:
            return self.make([source], target, tell)
        except (AgvMotionError, OSError) as error:
            took = time.perf_counter() - begin
            return EditOutcome(str(source), str(target), took=took, failure=str(error))

    def modules(self) -> tuple[str, ...]:
        """Return nothing: all that an edit needs is imported with this module."""
        return ()

    def apart(self) -> bool:
        """Return that it may be done in any process."""
        return False

    def lost(self, source: Path, reason: str) -> EditOutcome:
        """Return the outcome of a bag whose worker died."""
        return EditOutcome(str(source), '', failure=reason)

    def make(
        self, sources: Sequence[Path], target: Path, tell: Callable[[float], None] | None = None
    ) -> EditOutcome:
        """Make a bag of others; it appears when it is whole, and nothing is overwritten.

        Raises:
            ConfigurationError: Something does not fit the bags.
            SourceError: A bag is damaged, or the disk takes no more.

        """
        begin = time.perf_counter()
        bags: list[BagReader] = []
        try:
            with beside(target) as made, told(target):
                bags += map(BagReader, sources)
                what, notes = self.resolve(bags)
                write = edit_to_sqlite if self._storage(bags[0]) == SQLITE else edit
                report = write(bags, made, what, tell or (lambda _: None))
                carry([bag.path for bag in bags], made, what.spans)
        finally:
            for bag in bags:
                bag.close()
        sizes = sum(file.path.stat().st_size for bag in bags for file in bag.files), size(target)
        took = time.perf_counter() - begin
        problems = tuple(str(problem) for bag in bags for problem in bag.problems)
        source = ', '.join(map(str, sources))
        return EditOutcome(source, str(target), report, took, *sizes, notes, problems)

    def resolve(self, bags: Sequence[BagReader]) -> tuple[Edit, tuple[str, ...]]:
        """Return what is to become of bags, and what should be told of it.

        Raises:
            ConfigurationError: A topic, a field, a time or a condition is in none of the bags.

        """
        start = min((bag.start for bag in bags if bag.message_count), default=0)
        end = max((bag.end for bag in bags), default=0)
        self._require_topics(bags)
        spans, notes = self._spans(bags, start, end)
        compression = '' if self.compression == 'none' else self.compression
        what = Edit(
            self.topics, spans, self.latched, compression, self.ordered,
            file_size=ceil(self.part_size * 1e6),
        )  # fmt: skip
        return replace(what, parts=self._parts(spans, start, end)), notes

    def _storage(self, bag: BagReader) -> str:
        """Return the format of the new bag."""
        return self.storage or (SQLITE if bag.files[0].as_chunks() else MCAP)

    def _require_topics(self, bags: Sequence[BagReader]) -> None:
        topics = {topic for bag in bags for topic in bag.topics}
        for topic in (*self.topics.topics, *self.topics.exclude_topics):
            if topic not in topics:
                bags[0].require([topic])
        if topics and not any(map(self.topics.takes, topics)):
            msg = f'no topic is left of {bags[0].path}, {", ".join(sorted(topics))}: choose others'
            raise ConfigurationError(msg)

    def _spans(
        self, bags: Sequence[BagReader], start: int, end: int
    ) -> tuple[tuple[Span, ...] | None, tuple[str, ...]]:
        """Return the wanted times, and what is to be told of them."""
        first = moment(self.begin, start, end) if self.begin else 0
        stop = moment(self.end, start, end) if self.end else 2**64
        if self.begin and self.end and first >= stop:
            msg = f"from '{self.begin}' to '{self.end}': expected the earlier one first"
            raise ConfigurationError(msg)
        if (self.begin or self.end) and not (first <= end and stop > start):
            since, until = f'@{_seconds(start)}', f'@{_seconds(end)}'
            msg = (
                f"nothing was recorded from '{self.begin or since}' to '{self.end or until}': "
                f'{bags[0].path} reaches from {since} to {until}'
            )
            raise ConfigurationError(msg)
        if not self.around:
            return (((first, stop),) if self.begin or self.end else None), ()
        asked = condition(self.around)
        found = happenings(bags[0], asked)
        stamps = [stamp for stamp in found.stamps.tolist() if first <= stamp < stop]
        if not stamps:
            msg = f"'{asked}' was never met in bag {bags[0].path}: choose another value, or time"
            raise ConfigurationError(msg)
        around = windows(stamps, round(self.before * SECOND), round(self.after * SECOND))
        times = ', '.join(
            f'{_seconds(a - start)} to {_seconds(b - 1 - start)} s' for a, b in around[:MOST_TOLD]
        )
        more = f' and {len(around) - MOST_TOLD} more' if len(around) > MOST_TOLD else ''
        met = f'was met in {len(stamps)} messages, {found.events} times on end'
        return around, (f"'{asked}' {met}: {times}{more}",)

    def _parts(self, spans: tuple[Span, ...] | None, start: int, end: int) -> tuple[Span, ...]:
        length = ceil(self.part_duration * SECOND)
        if not length:
            return ()
        begin, stop = (spans[0][0], spans[-1][1]) if spans else (start, end + 1)
        begin, stop = max(begin, start), min(stop, end + 1)
        count = -(-(stop - begin) // length)
        if count > MOST_PARTS:
            msg = (
                f'{count} files of {self.part_duration:g} s each: expected at most {MOST_PARTS}; '
                'choose a longer time'
            )
            raise ConfigurationError(msg)
        return tuple((begin + i * length, begin + (i + 1) * length) for i in range(count))


MOST_TOLD = 5
"""windows that are told"""


class EditOutcome(NamedTuple):
    """What came of a bag."""

    source: str
    target: str
    report: EditReport | None = None
    """None where there is no new bag"""
    took: float = 0.0
    """[s]"""
    before: int = 0
    """[bytes] of the files of the bag"""
    after: int = 0
    """[bytes] of the files of the new one"""
    notes: tuple[str, ...] = ()
    """what should be told"""
    problems: tuple[str, ...] = ()
    """what is amiss in the bag, though all could be read"""
    failure: str = ''
    """why there is no new bag"""


def size(path: Path) -> int:
    """Return the size of the files in a folder [bytes]."""
    return sum(each.stat().st_size for each in path.iterdir())


def _seconds(nanoseconds: int) -> str:
    sign = '-' if nanoseconds < 0 else ''
    whole, rest = divmod(abs(nanoseconds), SECOND)
    return f'{sign}{whole}.{rest // 1_000_000:03d}'
