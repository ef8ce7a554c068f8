"""What is taken of a chunk: copied as it lies in the file, or some of its messages in a new one.

Whatever is taken, the chunk is unpacked first: its CRC must be right, its messages must be those of
its index, and there must be no others. So damage is never copied.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.compression import compressor
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import record_parsing, records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.chunk_content import message_offsets, stored_content
from agv_motion.bag.mcap.message_heads import HEAD
from agv_motion.bag.mcap.output import NewChunk
from agv_motion.bag.mcap.time_order import inside

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.chunked_file import ChunkedFile
    from agv_motion.bag.mcap.record_parsing import Buffer

_CHANNEL_AT = records.PREFIX.size
"""[bytes] in a message"""


class Wanted(NamedTuple):
    """What is to be taken of a file."""

    channels: Mapping[int, int]
    """those that are wanted, each with its id in the new file"""
    spans: Sequence[tuple[int, int]] | None = None
    """[ns] first log time, and that before which to stop, in order; None: all"""
    compression: str | None = None
    """of chunks: 'zstd', 'lz4' or ''; None: as they are"""
    ordered: bool = False
    """whether messages are to lie in the order of their log time"""
    foreign: frozenset[int] = frozenset()
    """channels that another description has in the new file: theirs must not be copied along"""

    def overlaps(self, chunk: Chunk) -> bool:
        """Return whether something of a chunk may be wanted, as far as its index tells."""
        if not chunk.filled or (
            chunk.indexes is not None and self.channels.keys().isdisjoint(chunk.indexes)
        ):
            return False
        return self.spans is None or any(a <= chunk.end and chunk.start < b for a, b in self.spans)


class Picked(NamedTuple):
    """Messages one behind the other, as they are to lie in a chunk."""

    content: bytes
    channels: NDArray[np.uint16]
    stamps: NDArray[np.uint64]
    """[ns] log times"""
    offsets: NDArray[np.uint64]
    """[bytes] of each in ``content``"""

    def packed(self, compression: str) -> NewChunk:
        """Return them as a chunk."""
        times = int(self.stamps.min()), int(self.stamps.max())
        stored = compressor(compression)(self.content)
        size, crc = len(self.content), crc32(self.content)
        entries = np.column_stack((self.stamps, self.offsets)).astype('<u8', copy=False)
        return NewChunk(times, size, crc, compression, stored, _by_channel(self.channels, entries))


def joined(parts: Sequence[Picked]) -> Picked:
    """Return messages of several parts behind each other."""
    if len(parts) == 1:
        return parts[0]
    begins = np.cumsum([0, *(len(part.content) for part in parts[:-1])]).astype(np.uint64)
    offsets = [part.offsets + begin for part, begin in zip(parts, begins, strict=True)]
    return Picked(
        b''.join(part.content for part in parts),
        np.concatenate([part.channels for part in parts]),
        np.concatenate([part.stamps for part in parts]),
        np.concatenate(offsets),
    )


def pick(file: ChunkedFile, chunk: Chunk, wanted: Wanted) -> NewChunk | Picked | None:
    """Return what is wanted of a chunk: itself as it is, or messages of it; None for nothing.

    Raises:
        DamagedBagError: The chunk, its index or its CRC is wrong.

    """
    there = _look(file, chunk)
    if not len(there.channels) or not wanted.channels:
        return None
    ids = np.full(max(int(there.channels.max()), *wanted.channels) + 1, -1, np.int32)
    ids[list(wanted.channels)] = list(wanted.channels.values())
    new = ids[there.channels]
    take = new >= 0
    if wanted.spans is not None:
        within = np.zeros(len(take), bool)
        for start, stop in wanted.spans:
            within |= inside(there.stamps, start, stop)
        take &= within
    if not take.any():
        return None
    disordered = wanted.ordered and bool((there.stamps[1:] < there.stamps[:-1]).any())
    if take.all() and not (disordered or chunk.bare) and (new == there.channels).all():
        copied = _copied(file, chunk, there, wanted)
        if copied is not None:
            return copied
    rows = np.flatnonzero(take)
    if disordered:
        rows = rows[np.argsort(there.stamps[rows], kind='stable')]
    return _gathered(there, rows, new[rows].astype(np.uint16))


def _copied(file: ChunkedFile, chunk: Chunk, there: _Look, wanted: Wanted) -> NewChunk | None:
    """Return the chunk as it is stored; None if it must be another in the new file."""
    head, stored = stored_content(file.data, chunk, file.path)
    if wanted.compression not in (None, head.compression) or not _may_be_copied(there, wanted):
        return None
    times = int(there.stamps.min()), int(there.stamps.max())
    crc = head.crc or crc32(there.content)
    indexes = {channel: rows.tobytes() for channel, rows in there.indexes.items()}
    if not indexes:
        entries = np.column_stack((there.stamps, there.offsets)).astype('<u8', copy=False)
        indexes = _by_channel(there.channels, entries)
    return NewChunk(times, head.size, crc, head.compression, stored, indexes, fresh=False)


class _Look(NamedTuple):
    """The messages of a chunk, in the order of its content, after a look at all of them."""

    content: Buffer
    channels: NDArray[np.uint16]
    stamps: NDArray[np.uint64]
    offsets: NDArray[np.uint64]
    ends: NDArray[np.uint64]
    """[bytes] where each ends in ``content``"""
    others: Sequence[tuple[int, int]]
    """ids of what else is in it, each after its opcode: descriptions of types and channels"""
    indexes: Mapping[int, NDArray[np.uint64]]
    """rows of the message index of each channel; empty where there is none"""


def _look(file: ChunkedFile, chunk: Chunk) -> _Look:
    content = file.unpacked(chunk)
    tables: dict[int, NDArray[np.uint64]] = {}
    if chunk.indexes is None:
        offsets = message_offsets(content).astype(np.uint64)
        found = file.heads(chunk, content, offsets)
        file.require_described(chunk, found)
    else:
        tables = {n: file.index_of(chunk, n, content) for n in chunk.indexes}
        table = np.concatenate([np.empty((0, 2), np.uint64), *tables.values()])
        numbers = np.repeat(list(tables), [len(one) for one in tables.values()])
        if len(tables) > 1:
            order = np.argsort(table[:, 1], kind='stable')
            table, numbers = table[order], numbers[order]
        offsets = table[:, 1]
        found = file.heads(chunk, content, offsets)
        wrong = (found['channel'] != numbers) | (found['stamp'] != table[:, 0])
        if wrong.any() or not tables.keys() <= file.channels.keys():
            file.require_described(chunk, found)
            finding = 'in this chunk, messages that are not those of its index'
            raise DamagedBagError(file.path, chunk.offset, finding)
    stamps = found['stamp']
    if len(stamps) and not chunk.start <= int(stamps.min()) <= int(stamps.max()) <= chunk.end:
        finding = f'in this chunk, messages outside of its time, {chunk.start} to {chunk.end} ns'
        raise DamagedBagError(file.path, chunk.offset, finding)
    ends = offsets + found['length'] + np.uint64(records.PREFIX.size)
    others = _between(file, chunk, content, offsets, ends)
    return _Look(content, found['channel'], stamps, offsets, ends, others, tables)


def _between(
    file: ChunkedFile,
    chunk: Chunk,
    content: Buffer,
    offsets: NDArray[np.uint64],
    ends: NDArray[np.uint64],
) -> list[tuple[int, int]]:
    """Return opcode and id of the descriptions that lie between the messages of a chunk.

    Raises:
        DamagedBagError: Messages overlap, or there are such as no index tells of.

    """
    begins = np.append(offsets, np.uint64(len(content)))
    before = np.append(np.uint64(0), ends)
    if (begins < before).any():
        finding = 'in this chunk, messages that lie in each other'
        raise DamagedBagError(file.path, chunk.offset, finding)
    found = []
    for gap in np.flatnonzero(begins > before).tolist():
        position = int(before[gap])
        for opcode, at, end in record_parsing.walk(content, position, int(begins[gap])):
            position = end
            if opcode == records.MESSAGE and end - at >= HEAD.itemsize - records.PREFIX.size:
                finding = 'in this chunk, messages that its index does not tell of'
                raise DamagedBagError(file.path, chunk.offset, finding)
            if opcode in (records.SCHEMA, records.CHANNEL) and end - at >= record_parsing.U16.size:
                found.append((opcode, record_parsing.U16.unpack_from(content, at)[0]))
        if position != begins[gap]:
            finding = f'in this chunk, a record without end at byte {position} of its content'
            raise DamagedBagError(file.path, chunk.offset, finding)
    return found


def _may_be_copied(there: _Look, wanted: Wanted) -> bool:
    """Return whether all descriptions in a chunk hold in the new file, too."""
    return all(
        number in wanted.channels and number not in wanted.foreign
        if opcode == records.CHANNEL
        else not wanted.foreign
        for opcode, number in there.others
    )


def _gathered(there: _Look, rows: NDArray[np.intp], channels: NDArray[np.uint16]) -> Picked:
    """Return some messages of a chunk, with their channels in the new file."""
    begins, ends = there.offsets[rows], there.ends[rows]
    content = memoryview(there.content)
    breaks = np.flatnonzero(begins[1:] != ends[:-1]) + 1
    firsts = begins[np.concatenate(([0], breaks))].tolist()
    lasts = ends[np.concatenate((breaks - 1, [len(rows) - 1]))].tolist()
    data = b''.join([content[a:b] for a, b in zip(firsts, lasts, strict=True)])
    sizes = ends - begins
    offsets = np.cumsum(sizes) - sizes
    if (channels != there.channels[rows]).any():
        changed = np.frombuffer(bytearray(data), np.uint8)
        places = offsets.astype(np.intp) + _CHANNEL_AT
        changed[places], changed[places + 1] = channels & 0xFF, channels >> 8
        data = changed.tobytes()
    return Picked(data, channels, there.stamps[rows], offsets)


def _by_channel(channels: NDArray[np.uint16], entries: NDArray[np.uint64]) -> dict[int, bytes]:
    """Return the entries of the message index of each channel."""
    order = np.argsort(channels, kind='stable')
    numbers, begins = np.unique(channels[order], return_index=True)
    parts = np.split(entries[order], begins[1:])
    return {int(n): part.tobytes() for n, part in zip(numbers, parts, strict=True)}
