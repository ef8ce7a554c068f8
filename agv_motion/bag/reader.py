"""Read a bag: a folder as rosbag2 leaves it, one MCAP file, or one sqlite3 file.

with BagReader('bag') as bag:
    for message in bag.messages(['/odom'], start=bag.start + 10**9):
        print(message.stamp, message.connection.topic, len(message.data))
"""

from __future__ import annotations

from difflib import get_close_matches
from functools import cached_property
from heapq import merge
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, final

from agv_motion.bag.bag_files import find, unpack_file
from agv_motion.bag.columns.message_batches import unpack_message
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.file_kind import MCAP, SQLITE, ZSTD, kind
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.metadata import FILE_NAME
from agv_motion.bag.request import listed, span_of
from agv_motion.bag.sqlite.file import SqliteFile
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from types import TracebackType

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.storage import Storage


@final
class BagReader:
    """Reads a bag with or without index and metadata, whole or torn, of any size."""

    def __init__(self, path: str | Path, *, validate: bool = True) -> None:
        """Open the bag.

        Args:
            path: Folder of the bag, or one of its files.
            validate: Compare chunks with their CRC, where the file has one.

        Raises:
            SourceError: There is no bag, or it cannot be read at all.

        """
        self.path = Path(path)
        found = find(self.path)
        self._found = found
        self._unpacked: TemporaryDirectory[str] | None = None
        self.files: list[Storage] = []
        try:
            for file in found.paths:
                self.files.append(self._open(file, kind(file), validate=validate))
        except BaseException:
            self.close()
            raise
        self.problems: list[SourceError] = [
            *found.problems,
            *(problem for file in self.files for problem in file.problems),
        ]
        """what is amiss in the bag, though it can be read"""
        self.connections: tuple[Connection, ...] = tuple(
            dict.fromkeys(c for file in self.files for c in file.channels.values())
        )
        """every topic with its type; a topic that changed its type has several"""
        self.topics: dict[str, Connection] = {}
        """the first connection of each topic, by name"""
        for connection in self.connections:
            self.topics.setdefault(connection.topic, connection)
        if all(file.counted for file in self.files) and self.message_count < found.messages:
            finding = f'it tells of {found.messages} messages, where {self.message_count} are'
            self.problems.append(DamagedBagError(self.path / FILE_NAME, 0, finding))

    @property
    def lossy(self) -> bool:
        """Whether something that the bag should hold cannot be read."""
        return not all(getattr(problem, 'harmless', False) for problem in self.problems)

    @property
    def messages_compressed(self) -> bool:
        """Whether each message is compressed by itself."""
        return self._found.messages_compressed

    @cached_property
    def start(self) -> int:
        """Log time of the first message [ns]; 0 without messages."""
        return min((file.span[0] for file in self.files if file.span), default=0)

    @cached_property
    def end(self) -> int:
        """Log time of the last message [ns]; 0 without messages."""
        return max((file.span[1] for file in self.files if file.span), default=0)

    @cached_property
    def counts(self) -> dict[str, int]:
        """Number of messages of each topic."""
        counts = dict.fromkeys(self.topics, 0)
        for connection, count in self.connection_counts.items():
            counts[connection.topic] += count
        return counts

    @cached_property
    def connection_counts(self) -> dict[Connection, int]:
        """Number of messages of each connection: what counts where a topic changed its type."""
        counts = dict.fromkeys(self.connections, 0)
        for file in self.files:
            for channel, count in file.counts().items():
                if channel in file.channels:
                    counts[file.channels[channel]] += count
        return counts

    @property
    def message_count(self) -> int:
        """Number of all messages."""
        return sum(self.counts.values())

    def require(self, topics: Iterable[str]) -> None:
        """Refuse topics that the bag does not have, and a bag that was closed.

        Raises:
            ConfigurationError: One is not there; close names are given.

        """
        for file in self.files:
            file.require_open()
        for topic in topics:
            if topic not in self.topics:
                close = get_close_matches(topic, self.topics)
                hint = (
                    f"did you mean '{close[0]}'?"
                    if close
                    else f'it has {", ".join(self.topics) or "none"}'
                )
                msg = f"bag {self.path} has no topic '{topic}'; {hint}"
                raise ConfigurationError(msg)

    def messages(
        self, topics: Iterable[str] | None = None, start: int | None = None, stop: int | None = None
    ) -> Iterator[Message]:
        """Yield messages in the order of their log time, few at a time in memory.

        Args:
            topics: Their names, or the name of one; None means all.
            start: [ns] first log time; None means the beginning.
            stop: [ns] log time before which to stop; None means never.

        Raises:
            ConfigurationError: A topic is not in the bag.
            DamagedBagError: What comes next is damaged.

        """
        wanted = None if topics is None else frozenset(listed(topics))
        self.require(wanted or ())
        return self._messages(wanted, *span_of(start, stop))

    def gaps(self) -> list[tuple[int, int]]:
        """Return the times between bags: a bag alone has none."""
        return []

    def close(self) -> None:
        """Let go of the files; messages already read stay valid."""
        for file in self.files:
            file.close()
        if self._unpacked:
            self._unpacked.cleanup()

    def __repr__(self) -> str:
        """Return one line."""
        return (
            f'BagReader({str(self.path)!r}: {len(self.topics)} topics in {len(self.files)} files)'
        )

    def __enter__(self) -> BagReader:
        """Return the reader."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the bag."""
        self.close()

    def _open(
        self, path: Path, found: str, *, validate: bool, unpacked: Path | None = None
    ) -> Storage:
        if found == SQLITE:
            return SqliteFile(path, unpacked)
        if found == MCAP:
            return McapFile(path, validate=validate, unpacked=unpacked)
        self._unpacked = self._unpacked or TemporaryDirectory()
        inside = unpack_file(path, Path(self._unpacked.name))
        if unpacked or kind(inside) == ZSTD:
            msg = f'{path} is compressed by zstd twice: unpack it first'
            raise SourceError(msg)
        return self._open(path, kind(inside), validate=validate, unpacked=inside)

    def _messages(self, topics: frozenset[str] | None, start: int, stop: int) -> Iterator[Message]:
        for group in _overlapping(self.files):
            streams = [
                file.messages(
                    [n for n, c in file.channels.items() if topics is None or c.topic in topics],
                    start,
                    stop,
                )
                for file in group
            ]
            stream = streams[0] if len(streams) == 1 else merge(*streams, key=lambda m: m.stamp)
            if self.messages_compressed:
                stream = (unpack_message(message, self.path) for message in stream)
            yield from stream


def _overlapping(files: list[Storage]) -> Iterator[list[Storage]]:
    """Yield groups of files that overlap in time, in the order of time."""
    filled = [(span, file) for file in files if (span := file.span)]
    group: list[Storage] = []
    latest = -1
    for (start, end), file in sorted(filled, key=lambda item: item[0][0]):
        if group and start > latest:
            yield group
            group = []
        group.append(file)
        latest = max(latest, end)
    if group:
        yield group
