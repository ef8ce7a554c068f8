"""One MCAP file in the making, as records: what is put into it, and the summary at its end.

A failure, such as a full disk, leaves the file as it was before the call that failed.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from agv_motion.bag.mcap.record_parsing import Buffer

_JOINED = 1 << 20
"""[bytes] Pieces are handed to the system together up to this size: a kill leaves all or none."""


class NewChunk(NamedTuple):
    """A chunk that is ready to be written."""

    times: tuple[int, int]
    """[ns] log time of the first and the last message"""
    size: int
    """[bytes] of its content, uncompressed"""
    crc: int
    """of its content, uncompressed"""
    compression: str
    stored: Buffer
    """its content as it is to lie in the file"""
    indexes: Mapping[int, bytes]
    """log time [ns] and offset of the messages of each channel, as they lie in the file"""
    fresh: bool = True
    """whether it is new, not that of another file"""

    @property
    def messages(self) -> int:
        """Number of its messages."""
        return sum(map(len, self.indexes.values())) // 16


class _Extra(NamedTuple):
    """An attachment, or named strings, in the file."""

    offset: int
    attached: bool
    entry: bytes
    """its record in the summary"""


class McapOutput:
    """Writes records into one new file, and remembers what its summary must tell."""

    def __init__(self, path: Path, profile: str = 'ros2', library: str = 'agv_motion') -> None:
        """Create the file.

        Args:
            path: The file; it must not exist.
            profile: What the messages are.
            library: Who writes.

        """
        self.path = path
        self.size = 0
        """[bytes] in the file so far"""
        self.schemas: dict[int, records.Schema] = {}
        self.channels: dict[int, records.Channel] = {}
        self._extras: list[_Extra] = []
        self._chunks: list[tuple[records.ChunkIndex, dict[int, int]]] = []
        """of each chunk its index, and the number of messages of each channel"""
        self._file = path.open('xb', buffering=0)
        self._put(records.MAGIC + records.header(profile, library))

    @property
    def start(self) -> int:
        """Log time of the first message [ns]; 2^64 - 1 without messages."""
        return min((index.start_time for index, _ in self._chunks), default=2**64 - 1)

    @property
    def end(self) -> int:
        """Log time of the last message [ns]; 0 without messages."""
        return max((index.end_time for index, _ in self._chunks), default=0)

    @property
    def channel_counts(self) -> dict[int, int]:
        """Number of messages of each channel."""
        counts = dict.fromkeys(self.channels, 0)
        for _, of_chunk in self._chunks:
            for channel, count in of_chunk.items():
                counts[channel] += count
        return counts

    def add_schema(self, schema: records.Schema) -> None:
        """Put the description of a type."""
        self._put(records.schema(schema))
        self.schemas[schema.id] = schema

    def add_channel(self, channel: records.Channel) -> None:
        """Put the description of a channel, whose schema was put before."""
        self._put(records.channel(channel))
        self.channels[channel.id] = channel

    def put_chunk(self, chunk: NewChunk) -> None:
        """Put a chunk with its indexes."""
        sizes = len(chunk.stored), chunk.size
        head = records.chunk_head(chunk.times, sizes, chunk.crc, chunk.compression)
        length = len(head) + len(chunk.stored)
        offsets, indexes, after = {}, [], 0
        for channel, entries in sorted(chunk.indexes.items()):
            offsets[channel] = self.size + length + after
            indexes.append(records.message_index(channel, entries))
            after += len(indexes[-1])
        index = records.ChunkIndex(
            *chunk.times, self.size, length, offsets, after, chunk.compression, *sizes
        )
        self._put(head, chunk.stored, b''.join(indexes))
        counts = {channel: len(entries) // 16 for channel, entries in chunk.indexes.items()}
        self._chunks.append((index, counts))

    def drop_chunk(self) -> bool:
        """Cut the last chunk off the file; return whether there was one."""
        if not self._chunks:
            return False
        index, _ = self._chunks.pop()
        self.size = index.offset
        self._extras = [extra for extra in self._extras if extra.offset < self.size]
        self._cut()
        return True

    def keep(self, extra: records.Attachment | records.Metadata) -> None:
        """Append an attachment or named strings."""
        offset = self.size
        if isinstance(extra, records.Attachment):
            data = records.attachment(extra)
            entry = records.attachment_index(extra, offset, len(data))
        else:
            data = records.metadata(extra)
            entry = records.metadata_index(offset, len(data), extra.name)
        self._put(data)
        self._extras.append(_Extra(offset, isinstance(extra, records.Attachment), entry))

    @property
    def closed(self) -> bool:
        """Whether the file is finished or abandoned."""
        return self._file.closed

    def sync(self) -> None:
        """Wait until the disk has what was put."""
        os.fdatasync(self._file.fileno())

    def close(self, notes: dict[str, str], *, sync: bool = True) -> None:
        """Write ``notes`` as metadata ``rosbag2`` and the summary behind the last chunk; close.

        Args:
            notes: Named strings.
            sync: Wait until the disk has everything.

        Raises:
            OSError: The disk is full or failed; the file is as it was before, and still open.

        """
        noted = records.metadata(records.Metadata('rosbag2', notes))
        index = records.metadata_index(self.size, len(noted), 'rosbag2')
        own = _Extra(self.size, attached=False, entry=index)
        data = noted + records.data_end()
        self._put(data + self._summary([*self._extras, own], self.size + len(data)))
        if sync:
            self.sync()
        self._file.close()

    def abandon(self) -> None:
        """Close without a summary: what was put stays, and can be recovered."""
        self._file.close()

    def _summary(self, extras: Sequence[_Extra], begin: int) -> bytes:
        """Return the summary, its offsets and the footer; ``begin`` is where it will stand."""
        counts = {channel: count for channel, count in self.channel_counts.items() if count}
        start, end = (self.start, self.end) if counts else (0, 0)
        attached = [extra.entry for extra in extras if extra.attached]
        noted = [extra.entry for extra in extras if not extra.attached]
        known = len(self.schemas), len(self.channels), len(attached), len(noted)
        chunks = [index for index, _ in self._chunks]
        totals = records.Statistics(sum(counts.values()), *known, len(chunks), start, end, counts)
        groups = {
            records.SCHEMA: b''.join(map(records.schema, self.schemas.values())),
            records.CHANNEL: b''.join(map(records.channel, self.channels.values())),
            records.STATISTICS: records.statistics(totals),
            records.CHUNK_INDEX: b''.join(map(records.chunk_index, chunks)),
            records.ATTACHMENT_INDEX: b''.join(attached),
            records.METADATA_INDEX: b''.join(noted),
        }
        offsets, position = [], begin
        for opcode, group in groups.items():
            if group:
                offsets.append(records.summary_offset(opcode, position, len(group)))
            position += len(group)
        foot = records.footer_head(begin, position)
        summary = b''.join((*groups.values(), *offsets, foot))
        return summary + records.checksum(crc32(summary)) + records.MAGIC

    def _put(self, *pieces: Buffer) -> None:
        """Append bytes; a failure leaves the file as it was before."""
        size = sum(map(len, pieces))
        try:
            for piece in [b''.join(pieces)] if size <= _JOINED else pieces:
                view = memoryview(piece)
                while view:
                    view = view[self._file.write(view) :]
        except OSError:
            self._cut()
            raise
        self.size += size

    def _cut(self) -> None:
        """End the file where ``size`` says."""
        os.ftruncate(self._file.fileno(), self.size)
        os.lseek(self._file.fileno(), self.size, os.SEEK_SET)
