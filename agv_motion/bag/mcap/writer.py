"""One MCAP file in the making: chunks with their index and CRC, and the summary at the end.

A chunk goes to the operating system in one piece as soon as it is complete, so a process that is
killed loses only the chunk it was filling. A disk that is full leaves the file as it was before,
and :meth:`McapWriter.drop_chunk` makes room for the summary.
"""

from __future__ import annotations

import os
from array import array
from struct import error as StructError  # noqa: N812 - the module names it in lower case
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.compression import compressor
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.chunk import HEAD
from agv_motion.bag.quality_of_service import as_yaml
from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.metadata import Topic

_MESSAGE_BODY = records.MESSAGE_HEAD.size - records.PREFIX.size
_MESSAGE_PREFIX = records.MESSAGE_HEAD.pack


class _Extra(NamedTuple):
    """An attachment, or named strings, in the file."""

    offset: int
    attached: bool
    entry: bytes
    """its record in the summary"""


class McapWriter:
    """Writes messages of several channels into one new file."""

    def __init__(self, path: Path, compression: str, library: str = 'agv_motion') -> None:
        """Create the file.

        Args:
            path: The file; it must not exist.
            compression: Of the chunks: 'zstd', 'lz4' or ''.
            library: Who writes.

        """
        self.path = path
        self.start, self.end = 2**64 - 1, 0
        self.counts: list[int] = []
        """number of messages of each channel; the first one has the id 1"""
        self.chunk_size = 0
        """[bytes] of the chunk being filled, uncompressed"""
        self.chunk_start = 0
        """[ns] log time of the first message in it"""
        self._compression, self._compress = compression, compressor(compression)
        self._file = path.open('xb', buffering=0)
        self._schemas: dict[tuple[str, str, str], records.Schema] = {}
        self._extras: list[_Extra] = []
        self._channels: list[records.Channel] = []
        self._chunks: list[records.ChunkIndex] = []
        self._chunk_counts: list[dict[int, int]] = []
        self._parts: list[bytes] = []
        self._indexes: list[array[int]] = []
        self.size = 0
        """[bytes] in the file so far"""
        self._put(records.MAGIC + records.header('ros2', library))

    def add_channel(self, topic: Topic) -> int:
        """Return the id of a new channel for ``topic``."""
        number = len(self._channels) + 1
        notes = {'offered_qos_profiles': as_yaml(topic.qos), 'topic_type_hash': topic.hash}
        notes = dict(topic.notes) or notes
        channel = records.Channel(number, self._schema(topic), topic.name, topic.encoding, notes)
        self._put(records.channel(channel))
        self._channels.append(channel)
        self._indexes.append(array('Q'))
        self.counts.append(0)
        return number

    def _schema(self, topic: Topic) -> int:
        """Return the id of the schema of a topic; 0 for a topic without type."""
        key = topic.type, topic.definition, topic.definition_encoding
        if not (topic.type or topic.definition):
            return 0
        if key not in self._schemas:
            number = len(self._schemas) + 1
            definition = topic.definition.encode(errors='surrogateescape')
            schema = records.Schema(number, topic.type, topic.definition_encoding, definition)
            self._put(records.schema(schema))
            self._schemas[key] = schema
        return self._schemas[key].id

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

    def write(self, channel: int, stamp: int, data: bytes, publish: int, sequence: int) -> None:
        """Append a message to the chunk being filled.

        Raises:
            SignalError: A number does not fit its field.

        """
        try:
            self._parts.append(
                _MESSAGE_PREFIX(
                    records.MESSAGE, _MESSAGE_BODY + len(data), channel, sequence, stamp, publish
                )
            )
        except StructError:
            msg = (
                f'log time {stamp}, publish time {publish}, sequence {sequence}: expected '
                'nanoseconds in [0, 2^64) and a sequence in [0, 2^32)'
            )
            raise SignalError(msg) from None
        self._parts.append(data)
        index = self._indexes[channel - 1]
        index.append(stamp)
        index.append(self.chunk_size)
        if not self.chunk_size:
            self.chunk_start = stamp
        self.chunk_size += records.MESSAGE_HEAD.size + len(data)

    def write_several(
        self, channels: NDArray[np.uint16], stamps: NDArray[np.uint64], data: Sequence[bytes]
    ) -> None:
        """Append messages that were sent when they were received, without a number of theirs."""
        heads = np.zeros(len(data), HEAD)
        heads['opcode'], heads['channel'] = records.MESSAGE, channels
        heads['length'] = np.fromiter(map(len, data), np.uint64, len(data))
        ends = np.cumsum(heads['length'] + np.uint64(HEAD.itemsize)) + np.uint64(self.chunk_size)
        offsets = ends - heads['length'] - np.uint64(HEAD.itemsize)
        heads['length'] += np.uint64(_MESSAGE_BODY)
        heads['stamp'] = heads['publish'] = stamps
        packed, size = heads.tobytes(), HEAD.itemsize
        parts = [b''] * (2 * len(data))
        parts[::2] = [packed[i : i + size] for i in range(0, len(packed), size)]
        parts[1::2] = data
        self._parts += parts
        entries = np.column_stack((stamps, offsets))
        for channel in np.unique(channels).tolist():
            self._indexes[channel - 1].frombytes(entries[channels == channel].tobytes())
        if not self.chunk_size:
            self.chunk_start = int(stamps[0])
        self.chunk_size = int(ends[-1])

    def flush(self) -> None:
        """Hand the chunk being filled to the operating system, with its index."""
        if not self.chunk_size:
            return
        chunk = b''.join(self._parts)
        stored = self._compress(chunk)
        filled = [(i, index) for i, index in enumerate(self._indexes, 1) if index]
        start, end = min(min(i[::2]) for _, i in filled), max(max(i[::2]) for _, i in filled)
        sizes = len(stored), len(chunk)
        head = records.chunk_head((start, end), sizes, crc32(chunk), self._compression)
        length, pieces, offsets = len(head) + len(stored), [head, stored], {}
        position = self.size + length
        for channel, index in filled:
            offsets[channel] = position
            pieces.append(records.message_index(channel, index.tobytes()))
            position += len(pieces[-1])
        where = self.size, length, offsets, position - self.size - length
        self._put(b''.join(pieces))
        self._chunks.append(records.ChunkIndex(start, end, *where, self._compression, *sizes))
        self.start, self.end = min(self.start, start), max(self.end, end)
        counts = {channel: len(index) // 2 for channel, index in filled}
        self._chunk_counts.append(counts)
        for channel, count in counts.items():
            self.counts[channel - 1] += count
        self.discard()

    def discard(self) -> None:
        """Forget the chunk being filled."""
        self._parts, self.chunk_size = [], 0
        self._indexes = [array('Q') for _ in self._channels]

    def drop_chunk(self) -> bool:
        """Cut the last chunk off the file; return whether there was one."""
        if not self._chunks:
            return False
        self.size = self._chunks.pop().offset
        for channel, count in self._chunk_counts.pop().items():
            self.counts[channel - 1] -= count
        self.start = min((chunk.start_time for chunk in self._chunks), default=2**64 - 1)
        self.end = max((chunk.end_time for chunk in self._chunks), default=0)
        self._extras = [extra for extra in self._extras if extra.offset < self.size]
        self._cut()
        return True

    @property
    def waiting(self) -> int:
        """Number of messages in the chunk being filled."""
        return len(self._parts) // 2

    @property
    def closed(self) -> bool:
        """Whether the file is finished or abandoned."""
        return self._file.closed

    def sync(self) -> None:
        """Wait until the disk has what was flushed."""
        os.fdatasync(self._file.fileno())

    def close(self, notes: dict[str, str]) -> None:
        """Write ``notes`` as metadata ``rosbag2`` and the summary behind the last chunk; close.

        Raises:
            OSError: The disk is full or failed; the file is as it was before, and still open.

        """
        noted = records.metadata(records.Metadata('rosbag2', notes))
        index = records.metadata_index(self.size, len(noted), 'rosbag2')
        own = _Extra(self.size, attached=False, entry=index)
        data = noted + records.data_end()
        self._put(data + self._summary([*self._extras, own], self.size + len(data)))
        self.sync()
        self._file.close()

    def abandon(self) -> None:
        """Close without a summary: what was flushed stays, and can be recovered."""
        self._file.close()

    def _summary(self, extras: Sequence[_Extra], begin: int) -> bytes:
        """Return the summary, its offsets and the footer; ``begin`` is where it will stand."""
        counts = {i: count for i, count in enumerate(self.counts, 1) if count}
        start, end = (self.start, self.end) if counts else (0, 0)
        attached = [extra.entry for extra in extras if extra.attached]
        noted = [extra.entry for extra in extras if not extra.attached]
        messages, schemas, channels = sum(self.counts), len(self._schemas), len(self._channels)
        numbers = messages, schemas, channels, len(attached), len(noted)
        totals = records.Statistics(*numbers, len(self._chunks), start, end, counts)
        groups = {
            records.SCHEMA: b''.join(map(records.schema, self._schemas.values())),
            records.CHANNEL: b''.join(map(records.channel, self._channels)),
            records.STATISTICS: records.statistics(totals),
            records.CHUNK_INDEX: b''.join(map(records.chunk_index, self._chunks)),
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

    def _put(self, data: bytes) -> None:
        """Append bytes; a failure leaves the file as it was before."""
        view = memoryview(data)
        try:
            while view:
                view = view[self._file.write(view) :]
        except OSError:
            self._cut()
            raise
        self.size += len(data)

    def _cut(self) -> None:
        """End the file where ``size`` says."""
        os.ftruncate(self._file.fileno(), self.size)
        os.lseek(self._file.fileno(), self.size, os.SEEK_SET)
