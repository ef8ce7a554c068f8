"""One MCAP file in memory: its topics, its chunks, and where their messages lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.connection import Message
from agv_motion.bag.damage import CLOSED, DamagedBagError
from agv_motion.bag.mcap import message_index, records
from agv_motion.bag.mcap.chunk_cache import ChunkCache
from agv_motion.bag.mcap.chunk_content import LARGEST, content, message_offsets
from agv_motion.bag.mcap.mapped import release
from agv_motion.bag.mcap.message_heads import HEAD, heads
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.connection import Connection
    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.record_parsing import Buffer
    from agv_motion.bag.mcap.records import Statistics
    from agv_motion.bag.mcap.summary import Summary


class Entries(NamedTuple):
    """Where some messages of a chunk lie."""

    stamps: NDArray[np.uint64]
    """[ns] log time of each"""
    offsets: NDArray[np.uint64]
    """[bytes] of each in the content of the chunk; without a sign, since numpy would join such
    numbers and others as floats, 256 ns apart"""


class ChunkedFile:
    """Finds what lies where in a file with or without index, whole or torn."""

    def __init__(
        self, path: Path, data: memoryview, found: Summary, channels: Mapping[int, Connection],
        *, validate: bool = True,
    ) -> None:  # fmt: skip
        """Keep what is in the file.

        Args:
            path: The file, for errors.
            data: Its bytes.
            found: What is in it.
            channels: Its channels, by their ids.
            validate: Compare chunks with their CRC, where the file has one.

        """
        self.path = path
        self.problems = list(found.problems)
        """what is amiss in the file, though it can be read"""
        self.channels = channels
        self._mapped: memoryview | None = data
        self.summary = found
        self._validate = validate
        self._cache = ChunkCache()

    @property
    def chunks(self) -> Sequence[Chunk]:
        """Its chunks, in the order of the file."""
        return self.summary.chunks

    @property
    def indexed(self) -> bool:
        """Whether the summary at its end was there to be used."""
        return self.summary.indexed

    @property
    def statistics(self) -> Statistics | None:
        """Totals of the file; None where it has none."""
        return self.summary.statistics

    @property
    def data(self) -> memoryview:
        """The bytes of the file.

        Raises:
            SourceError: It was closed.

        """
        if self._mapped is None:
            raise SourceError(CLOSED.format(self.path))
        return self._mapped

    def require_open(self) -> None:
        """Refuse to go on once the file was closed.

        Raises:
            SourceError: It was.

        """
        _ = self.data

    @property
    def span(self) -> tuple[int, int] | None:
        """Log time of the first and the last message [ns]; None without messages."""
        filled = [chunk for chunk in self.chunks if chunk.filled]
        if not filled:
            return None
        return min(chunk.start for chunk in filled), max(chunk.end for chunk in filled)

    @property
    def counted(self) -> bool:
        """Whether the number of messages is known without a walk through the file."""
        return self.statistics is not None

    def counts(self) -> dict[int, int]:
        """Return the number of messages of each channel."""
        if self.statistics is not None and self.statistics.channel_messages:
            return dict(self.statistics.channel_messages)
        counts = dict.fromkeys(self.channels, 0)
        for chunk in self.chunks:
            for channel, entries in self.entries(chunk).items():
                counts[channel] = counts.get(channel, 0) + len(entries.stamps)
        return counts

    @property
    def unpacked_size(self) -> int:
        """[bytes] of all chunks, uncompressed, as far as it can be believed."""
        return sum(min(chunk.size, LARGEST) for chunk in self.chunks)

    def expected(self, start: int, stop: int) -> dict[int, int]:
        """Return how many messages of each channel there are at most in a time.

        Nothing is unpacked: where a chunk has no index, its messages are not counted.

        Args:
            start: [ns] first log time.
            stop: [ns] log time before which to stop.

        """
        counts: dict[int, int] = {}
        for chunk in self.chunks:
            if chunk.end >= start and chunk.start < stop:
                for channel, at in (chunk.indexes or {}).items():
                    most = message_index.most(self.data, at)
                    counts[channel] = counts.get(channel, 0) + most
        self.release(0, len(self.data))
        return counts

    def index_of(self, chunk: Chunk, channel: int, unpacked: Buffer) -> NDArray[np.uint64]:
        """Return log time [ns] and offset of the messages of a channel in a chunk, as rows.

        Raises:
            DamagedBagError: The index or the chunk is damaged.

        """
        if chunk.indexes is None:
            entries = self.entries(chunk, unpacked).get(channel)
            if entries is None:
                return message_index.NONE
            return np.column_stack([entries.stamps, entries.offsets])
        at = chunk.indexes.get(channel)
        return (
            message_index.NONE
            if at is None
            else message_index.rows(self.data, channel, at, self.path)
        )

    def entries(
        self, chunk: Chunk, unpacked: Buffer | None = None, wanted: Container[int] | None = None
    ) -> dict[int, Entries]:
        """Return where the messages of each channel, or each wanted one, lie in a chunk.

        Args:
            chunk: Which.
            unpacked: Its content, if that is at hand.
            wanted: Ids of channels; None means all.

        Raises:
            DamagedBagError: The index or the chunk is damaged.

        """
        if chunk.indexes is not None:
            return self._indexed(chunk, wanted)
        unpacked = self.content(chunk) if unpacked is None else unpacked
        offsets = message_offsets(unpacked)
        found = self.heads(chunk, unpacked, offsets)
        channels = found['channel']
        entries = {}
        for channel in np.unique(channels):
            if wanted is not None and int(channel) not in wanted:
                continue
            mine = channels == channel
            entries[int(channel)] = Entries(found['stamp'][mine], offsets[mine].astype(np.uint64))
        return entries

    def _indexed(self, chunk: Chunk, wanted: Container[int] | None) -> dict[int, Entries]:
        """Return what its indexes say of wanted channels in a chunk."""
        tables = {
            channel: message_index.rows(self.data, channel, at, self.path)
            for channel, at in (chunk.indexes or {}).items()
            if wanted is None or channel in wanted
        }
        times = np.concatenate([message_index.NONE[:, 0], *(t[:, 0] for t in tables.values())])
        if len(times) and not chunk.start <= int(times.min()) <= int(times.max()) <= chunk.end:
            finding = f'a message index of times outside of its chunk at byte {chunk.offset}'
            raise DamagedBagError(self.path, self._outside(chunk, tables), finding)
        return {channel: Entries(table[:, 0], table[:, 1]) for channel, table in tables.items()}

    def _outside(self, chunk: Chunk, tables: Mapping[int, NDArray[np.uint64]]) -> int:
        """Return where the index lies that tells of times outside of its chunk [bytes]."""
        low, high = np.uint64(chunk.start), np.uint64(chunk.end)
        wrong = (c for c, t in tables.items() if ((t[:, 0] < low) | (t[:, 0] > high)).any())
        return (chunk.indexes or {})[next(wrong)]

    def unpacked(self, chunk: Chunk, target: memoryview | None = None) -> Buffer:
        """Return the uncompressed content of a chunk, without keeping it; for any thread.

        Args:
            chunk: Which.
            target: Write it here, if it has room for ``chunk.size`` bytes.

        Raises:
            DamagedBagError: It is damaged.

        """
        validate = self._validate
        return content(self.data, chunk, self.path, validate=validate, target=target)

    def content(self, chunk: Chunk) -> Buffer:
        """Return the uncompressed content of a chunk, and keep it for a while.

        Raises:
            DamagedBagError: It is damaged.

        """
        return self._cache.content(chunk, self.unpacked)

    def forget(self, chunk: Chunk) -> None:
        """Keep the content of a chunk no more, and what is mapped of it."""
        self._cache.forget(chunk)
        self.release_chunk(chunk)

    def heads(
        self, chunk: Chunk, unpacked: Buffer, offsets: NDArray[Any], form: np.dtype[Any] = HEAD
    ) -> NDArray[Any]:
        """Return what stands before the messages at ``offsets`` of a chunk's content.

        Raises:
            DamagedBagError: There is no message at one of them.

        """
        try:
            return heads(unpacked, offsets, form)
        except ValueError as error:
            raise DamagedBagError(self.path, chunk.offset, f'in this chunk, {error}') from None

    def release(self, begin: int, end: int) -> None:
        """Take a part of the file [bytes] out of the memory of this process; it stays readable."""
        release(self.data, begin, end)

    def release_chunk(self, chunk: Chunk) -> None:
        """Release a chunk with its indexes."""
        self.release(chunk.offset, chunk.offset + chunk.length + chunk.index_length)

    def close(self) -> None:
        """Let go of the file; messages already read stay valid."""
        self._cache.clear()
        self._mapped = None

    def messages_at(self, content: Buffer, offsets: list[int]) -> Iterator[Message]:
        """Yield the messages that lie at some places in the content of a chunk."""
        unpacked = memoryview(content)
        unpack, size, prefix = records.MESSAGE_HEAD.unpack_from, records.MESSAGE_HEAD.size, 9
        channels = self.channels
        for offset in offsets:
            _, length, channel, sequence, stamp, publish = unpack(unpacked, offset)
            data = bytes(unpacked[offset + size : offset + prefix + length])
            yield Message(channels[channel], stamp, data, publish, sequence)

    def require_described(self, chunk: Chunk, found: NDArray[Any]) -> None:
        """Refuse messages of channels that nothing describes.

        Args:
            chunk: They are in it, or in one after it.
            found: Their :meth:`heads`.

        Raises:
            DamagedBagError: There is one.

        """
        for channel in np.unique(found['channel']):
            if int(channel) not in self.channels:
                finding = f'in this chunk, a message of channel {channel}, which is not described'
                raise DamagedBagError(self.path, chunk.offset, finding)
