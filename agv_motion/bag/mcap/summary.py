"""What an MCAP file holds, from the summary at its end."""

from __future__ import annotations

from itertools import pairwise
from struct import Struct
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import record_parsing as parsing
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.chunk import Chunk
from agv_motion.bag.mcap.mapped import release

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

_FOOT = Struct('<QQI')
_LOOKED_AT = 512
"""Chunks; the system maps some pages around each, which a large file would have many of"""


class Summary(NamedTuple):
    """What a file holds, and where."""

    schemas: Mapping[int, records.Schema]
    channels: Mapping[int, records.Channel]
    chunks: Sequence[Chunk]
    """in the order of the file"""
    statistics: records.Statistics | None
    problems: Sequence[DamagedBagError] = ()
    """what was amiss, though the file can be read"""
    indexed: bool = True
    """whether this comes from the summary, not from a walk through the file"""


def read(data: memoryview, path: Path) -> Summary | None:
    """Return the summary; None where the file has none.

    Raises:
        DamagedBagError: There is one, but it cannot be true.

    """
    foot = len(data) - len(records.MAGIC) - records.FOOTER_LENGTH
    if foot < len(records.MAGIC) or data[-len(records.MAGIC) :] != records.MAGIC:
        return None
    if records.PREFIX.unpack_from(data, foot) != (records.FOOTER, _FOOT.size):
        raise DamagedBagError(path, foot, 'no footer before the end of the file')
    start, _, crc = _FOOT.unpack_from(data, foot + records.PREFIX.size)
    if start == 0:
        return None
    if not len(records.MAGIC) <= start <= foot:
        finding = f'a summary at byte {start} of a file of {len(data)}'
        raise DamagedBagError(path, foot, finding)
    if crc and crc32(data[start : len(data) - len(records.MAGIC) - 4]) != crc:
        raise DamagedBagError(path, start, 'a summary that does not match its CRC')
    return _records(data, path, start, foot)


def _records(data: memoryview, path: Path, start: int, foot: int) -> Summary:
    schemas: dict[int, records.Schema] = {}
    channels: dict[int, records.Channel] = {}
    chunks: list[Chunk] = []
    statistics, position = None, start
    for opcode, at, position in parsing.walk(data, start, foot):
        body = parsing.Body(data[at:position], path, at)
        if opcode == records.SCHEMA:
            schema = parsing.schema(body)
            schemas[schema.id] = schema
        elif opcode == records.CHANNEL:
            channel = parsing.channel(body)
            channels[channel.id] = channel
        elif opcode == records.STATISTICS:
            statistics = parsing.statistics(body)
        elif opcode == records.CHUNK_INDEX:
            chunks.append(_chunk(parsing.chunk_index(body), data, path, at))
            if not len(chunks) % _LOOKED_AT:
                release(data, 0, start)
    if position != foot:
        raise DamagedBagError(path, position, 'a record of the summary that has no end')
    chunks.sort(key=lambda chunk: chunk.offset)
    for one, other in pairwise(chunks):
        if one.offset + one.length > other.offset:
            raise DamagedBagError(path, other.offset, 'two chunks in the same place')
    return Summary(schemas, channels, chunks, statistics)


def _chunk(index: records.ChunkIndex, data: memoryview, path: Path, at: int) -> Chunk:
    end = index.offset + index.length
    if index.length < records.PREFIX.size or end > len(data):
        finding = f'a chunk from byte {index.offset} to {end} of a file of {len(data)}'
        raise DamagedBagError(path, at, finding)
    opcode, length = records.PREFIX.unpack_from(data, index.offset)
    if (opcode, length) != (records.CHUNK, index.length - records.PREFIX.size):
        raise DamagedBagError(path, index.offset, f'no chunk of {index.length} bytes')
    size = index.uncompressed_size
    offsets = index.index_offsets or (None if size else {})
    times = index.start_time, index.end_time
    where = index.offset, index.length
    return Chunk(*where, *times, size, offsets, index_length=index.index_length)


def complete(summary: Summary) -> bool:
    """Return whether the summary describes every chunk and all that is in them."""
    statistics, channels = summary.statistics, summary.channels
    if statistics is None or statistics.chunks != len(summary.chunks):
        return False
    counts = statistics.channel_messages
    if counts and sum(counts.values()) != statistics.messages:
        return False
    named = {number for chunk in summary.chunks for number in chunk.indexes or ()}
    return (
        not any(chunk.unindexed for chunk in summary.chunks)
        and named <= channels.keys()
        and counts.keys() <= channels.keys()
        and all(c.schema_id in summary.schemas or not c.schema_id for c in channels.values())
    )
