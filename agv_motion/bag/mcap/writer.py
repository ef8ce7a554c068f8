"""One MCAP file in the making: chunks with their index and CRC, and the summary at the end.

A chunk goes to the operating system in one piece as soon as it is complete, so a process that is
killed loses only the chunk it was filling. A disk that is full leaves the file as it was before,
and :meth:`McapWriter.drop_chunk` makes room for the summary.
"""

from __future__ import annotations

from array import array
from struct import error as StructError  # noqa: N812 - the module names it in lower case
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.compression import compressor
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.message_heads import HEAD, headed
from agv_motion.bag.mcap.output import McapOutput, NewChunk
from agv_motion.bag.quality_of_service import as_yaml
from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.metadata import Topic

_MESSAGE_BODY = records.MESSAGE_HEAD.size - records.PREFIX.size
_MESSAGE_PREFIX = records.MESSAGE_HEAD.pack


class McapWriter(McapOutput):
    """Writes messages of several channels into one new file, chunk by chunk."""

    def __init__(self, path: Path, compression: str, library: str = 'agv_motion') -> None:
        """Create the file.

        Args:
            path: The file; it must not exist.
            compression: Of the chunks: 'zstd', 'lz4' or ''.
            library: Who writes.

        """
        compress = compressor(compression)
        super().__init__(path, library=library)
        self.chunk_size = 0
        """[bytes] of the chunk being filled, uncompressed"""
        self.chunk_start = 0
        """[ns] log time of the first message in it"""
        self._compression, self._compress = compression, compress
        self._schema_ids: dict[tuple[str, str, str], int] = {}
        self._parts: list[bytes] = []
        self._indexes: list[array[int]] = []

    @property
    def counts(self) -> list[int]:
        """Number of messages of each channel; the first one has the id 1."""
        return list(self.channel_counts.values())

    def add_topic(self, topic: Topic) -> int:
        """Return the id of a new channel for ``topic``."""
        number = len(self.channels) + 1
        schema = self._schema(topic)
        self.add_channel(channel_of(topic, number, schema))
        self._indexes.append(array('Q'))
        return number

    def _schema(self, topic: Topic) -> int:
        """Return the id of the schema of a topic; 0 for a topic without type."""
        if not (topic.type or topic.definition):
            return 0
        key = topic.type, topic.definition, topic.definition_encoding
        if key not in self._schema_ids:
            schema = schema_of(topic, len(self._schema_ids) + 1)
            self.add_schema(schema)
            self._schema_ids[key] = schema.id
        return self._schema_ids[key]

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
        heads['channel'], heads['stamp'], heads['publish'] = channels, stamps, stamps
        parts, offsets = headed(heads, data)
        offsets += np.uint64(self.chunk_size)
        self._parts += parts
        entries = np.column_stack((stamps, offsets))
        for channel in np.unique(channels).tolist():
            self._indexes[channel - 1].frombytes(entries[channels == channel].tobytes())
        if not self.chunk_size:
            self.chunk_start = int(stamps[0])
        self.chunk_size = int(offsets[-1]) + HEAD.itemsize + len(data[-1])

    def flush(self) -> None:
        """Hand the chunk being filled to the operating system, with its index."""
        if not self.chunk_size:
            return
        chunk = b''.join(self._parts)
        filled = {i: index for i, index in enumerate(self._indexes, 1) if index}
        times = (
            min(min(index[::2]) for index in filled.values()),
            max(max(index[::2]) for index in filled.values()),
        )
        entries = {channel: index.tobytes() for channel, index in filled.items()}
        packed = self._compress(chunk)
        self.put_chunk(
            NewChunk(times, len(chunk), crc32(chunk), self._compression, packed, entries)
        )
        self.discard()

    def discard(self) -> None:
        """Forget the chunk being filled."""
        self._parts, self.chunk_size = [], 0
        self._indexes = [array('Q') for _ in self.channels]

    @property
    def waiting(self) -> int:
        """Number of messages in the chunk being filled."""
        return len(self._parts) // 2


def schema_of(topic: Topic, number: int) -> records.Schema:
    """Return what describes the type of a topic."""
    definition = topic.definition.encode(errors='surrogateescape')
    return records.Schema(number, topic.type, topic.definition_encoding, definition)


def channel_of(topic: Topic, number: int, schema: int) -> records.Channel:
    """Return what describes a topic; ``schema`` is the id of its type, 0 without."""
    notes = {'offered_qos_profiles': as_yaml(topic.qos), 'topic_type_hash': topic.hash}
    notes = dict(topic.notes) or notes
    return records.Channel(number, schema, topic.name, topic.encoding, notes)
