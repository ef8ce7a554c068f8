"""What an MCAP file holds, by walking through it: for files without index, torn or not chunked."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import record_parsing as parsing
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.chunk import INDEX_ENTRY, INDEX_HEAD, Chunk
from agv_motion.bag.mcap.chunk_content import content, message_offsets
from agv_motion.bag.mcap.mapped import release
from agv_motion.bag.mcap.message_heads import HEAD, heads
from agv_motion.bag.mcap.summary import Summary, complete, read

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.bag.mcap.records import Statistics

STRETCH = 1 << 22
"""[bytes] Messages outside chunks are taken together up to this size."""
_SHORTEST_MESSAGE = HEAD.itemsize - records.PREFIX.size
_U16_SIZE = parsing.U16.size
_PIECE = 1 << 24
"""[bytes] whose CRC is computed at a time"""


def look(data: memoryview, path: Path, *, believe: bool = True) -> Summary:
    """Return what is in a file by its summary, or by a walk through all, and what is amiss.

    Args:
        data: The whole file.
        path: The file, for errors.
        believe: Go by its summary, where that agrees with what lies in the file.

    """
    told, problems = None, list[DamagedBagError]()
    if believe:
        try:
            told = read(data, path)
            if told is not None and complete(told):
                found = between(data, path, told)
                if found is not None:
                    return found
        except DamagedBagError as error:
            problems.append(error)
    found = scan(data, path, told.statistics if told else None)
    return found._replace(problems=[*problems, *found.problems])


def scan(data: memoryview, path: Path, told: Statistics | None = None) -> Summary:
    """Return what the file holds up to its last whole record, and the chunk torn after it.

    Args:
        data: The whole file.
        path: The file, for errors.
        told: Statistics of the file, where it has some; if they tell another number of messages
            than is found, no message index is believed, and that is a problem.

    """
    walk = _Walk(data, path)
    walk.through()
    if told is not None and told.messages != walk.messages:
        walk = _Walk(data, path, believe=False)
        walk.through()
        finding = f'statistics of {told.messages} messages, where {walk.messages} are found'
        walk.problems.append(DamagedBagError(path, 0, finding, 'those that are found are read'))
    told_of = walk.described
    return Summary(
        told_of.schemas, told_of.channels, walk.chunks, None, walk.problems, indexed=False
    )


def between(data: memoryview, path: Path, summary: Summary) -> Summary | None:
    """Return a summary with the messages outside chunks, which no index tells of.

    Args:
        data: The whole file.
        path: The file, for errors.
        summary: What the summary at the end of the file says.

    Returns:
        None where its statistics tell another number of messages than lies in the file, or where
        there is something else between the chunks than whole records.

    """
    walk = _Walk(data, path)
    described = walk.described
    described.schemas.update(summary.schemas)
    described.channels.update(summary.channels)
    position = len(records.MAGIC)
    for chunk in summary.chunks:
        if not walk.stretch(position, chunk.offset):
            return None
        walk.chunks.append(chunk)
        walk.messages += chunk.indexed_messages
        position = chunk.offset + chunk.length + chunk.index_length
    statistics = summary.statistics
    whole = walk.stretch(position, len(data)) and not walk.problems
    whole = whole and not described.missing()
    if not whole or statistics is None or statistics.messages != walk.messages:
        return None
    return Summary(described.schemas, described.channels, walk.chunks, statistics)


def unlike_crc(data: memoryview, path: Path, end: int) -> DamagedBagError | None:
    """Return what is wrong where the data of a file do not match their CRC.

    Args:
        data: The whole file.
        path: The file, for errors.
        end: [bytes] where the record stands that ends the data, and has their CRC if any.

    """
    _, length = records.PREFIX.unpack_from(data, end)
    body = end + records.PREFIX.size
    crc = int.from_bytes(data[body : body + 4], 'little') if length >= 4 else 0
    found = 0
    for begin in range(0, end if crc else 0, _PIECE):
        found = crc32(data[begin : min(begin + _PIECE, end)], found)
        release(data, begin, begin + _PIECE)
    if crc == found:
        return None
    finding = f'all bytes before have CRC {found:08x}, expected {crc:08x}: one of them is wrong'
    return DamagedBagError(path, end, finding)


class _Descriptions:
    """The schemas and channels that a walk has met; the first of each number counts."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self.schemas: dict[int, records.Schema] = {}
        self.channels: dict[int, records.Channel] = {}
        self._needed: dict[int, int] = {}

    def take(self, opcode: int, data: parsing.Buffer, at: int) -> None:
        """Take up a record, if it is a schema or a channel; ``at`` tells where, for errors."""
        if opcode == records.SCHEMA:
            schema = parsing.schema(parsing.Body(data, self._path, at))
            self.schemas.setdefault(schema.id, schema)
        elif opcode == records.CHANNEL:
            channel = parsing.channel(parsing.Body(data, self._path, at))
            self.channels.setdefault(channel.id, channel)

    def need(self, channel_id: int, at: int) -> None:
        """Note a message of a channel, and where it lies [bytes]."""
        self._needed.setdefault(channel_id, at)

    def missing(self) -> list[DamagedBagError]:
        """Return where messages lie of channels that nothing describes: nobody can read them."""
        finding = 'here, messages of channel {}, which is not described'
        return [
            DamagedBagError(self._path, at, finding.format(channel))
            for channel, at in self._needed.items()
            if channel not in self.channels
        ]

    def has(self, channel_id: int) -> bool:
        """Return whether a channel is described, and its schema too."""
        channel = self.channels.get(channel_id)
        return channel is not None and (channel.schema_id == 0 or channel.schema_id in self.schemas)


class _Walk:
    """A walk through the data section."""

    def __init__(self, data: memoryview, path: Path, *, believe: bool = True) -> None:
        self._data, self._path, self._believe = data, path, believe
        self.described = _Descriptions(path)
        self.chunks: list[Chunk] = []
        self.problems: list[DamagedBagError] = []
        self.messages = 0

    def through(self) -> None:
        """Walk from the first record to the end of the data, or to where the file is torn."""
        end, whole = self._walk(len(records.MAGIC), len(self._data))
        if not whole:
            self._torn(end)
        self._learn()
        self.problems += self.described.missing()

    def stretch(self, position: int, end: int) -> bool:
        """Walk from one byte to another; return whether whole records fill that, or data ends."""
        stopped, whole = self._walk(position, end)
        return whole or stopped == end

    def _walk(self, position: int, end: int) -> tuple[int, bool]:
        """Return where the walk ended, and whether at the end of the data."""
        for opcode, at, after in parsing.walk(self._data, position, end):
            position = after
            try:
                self._record(opcode, at, after)
            except DamagedBagError as error:
                self.problems.append(error)
            if opcode == records.DATA_END:
                return position, True
        return position, False

    def _record(self, opcode: int, at: int, end: int) -> None:
        if opcode in {records.SCHEMA, records.CHANNEL}:
            self.described.take(opcode, self._data[at:end], at)
        elif opcode == records.CHUNK:
            self._chunk(at, end)
        elif opcode == records.MESSAGE_INDEX and self.chunks and end - at >= _U16_SIZE:
            (channel_id,) = parsing.U16.unpack_from(self._data, at)
            self._index(channel_id, at - records.PREFIX.size, end - at)
        elif opcode == records.MESSAGE and end - at >= _SHORTEST_MESSAGE:
            self._message(at - records.PREFIX.size, end)
        elif opcode == records.DATA_END and any(chunk.bare for chunk in self.chunks):
            wrong = unlike_crc(self._data, self._path, at - records.PREFIX.size)
            self.problems += [wrong] if wrong else []  # what is in chunks has a CRC of its own

    def _chunk(self, at: int, end: int) -> None:
        head = parsing.chunk_head(parsing.Body(self._data[at:end], self._path, at), at)
        offset = at - records.PREFIX.size
        self.chunks.append(Chunk(offset, end - offset, head.start, head.end, head.size, None))

    def _index(self, channel_id: int, at: int, length: int) -> None:
        """Note the index of a channel in the last chunk; one without messages says nothing."""
        chunk, entries = self.chunks[-1], (length - INDEX_HEAD) // INDEX_ENTRY
        if self._believe and not chunk.bare and entries > 0:
            self.chunks[-1] = chunk._replace(indexes={**(chunk.indexes or {}), channel_id: at})
            self.messages += entries

    def _message(self, offset: int, end: int) -> None:
        """Add a message outside chunks to the stretch before it, or begin another stretch."""
        _, _, channel, _, stamp, _ = records.MESSAGE_HEAD.unpack_from(self._data, offset)
        self.described.need(channel, offset)
        self.messages += 1
        last = self.chunks[-1] if self.chunks else None
        if last and last.bare and last.offset + last.length == offset and last.length < STRETCH:
            start, latest = min(last.start, stamp), max(last.end, stamp)
            size = end - last.offset
            self.chunks[-1] = last._replace(length=size, size=size, start=start, end=latest)
        else:
            size = end - offset
            self.chunks.append(Chunk(offset, size, stamp, stamp, size, None, bare=True))

    def _torn(self, position: int) -> None:
        """Note where the file is torn; keep what can be saved of a chunk there."""
        finding = 'the file ends here, before the end of its data'
        self.problems.append(DamagedBagError(self._path, position, finding))
        if self.chunks and self.chunks[-1].indexes:
            self.chunks[-1] = self.chunks[-1]._replace(indexes=None)  # some may be missing
        rest, size = len(self._data) - position, records.PREFIX.size
        if rest < size or self._data[position] != records.CHUNK:
            return
        at = position + size
        try:
            head = parsing.chunk_head(parsing.Body(self._data[at:], self._path, at), at)
        except DamagedBagError:
            return
        self.chunks.append(Chunk(position, rest, head.start, head.end, head.size, None, torn=True))

    def _learn(self) -> None:
        """Look into chunks of which something is not known: a channel, a schema, what they hold."""
        described = self.described.has
        for number, chunk in enumerate(self.chunks):
            for channel in chunk.indexes or ():
                self.described.need(channel, chunk.offset)
            if chunk.bare or (chunk.indexes and all(map(described, chunk.indexes))):
                continue
            try:
                inside = content(self._data, chunk, self._path, validate=False)
                for opcode, at, end in parsing.walk(inside, 0, len(inside)):
                    self.described.take(opcode, inside[at:end], chunk.offset)
            except DamagedBagError as error:
                self.problems.append(error)
                continue
            if chunk.indexes is None or not all(map(described, chunk.indexes)):
                self.chunks[number] = self._counted(chunk, inside)

    def _counted(self, chunk: Chunk, inside: parsing.Buffer) -> Chunk:
        """Return a chunk that is to be read without its index, with the times of its messages."""
        try:
            found = heads(inside, message_offsets(inside))
        except ValueError:
            return chunk._replace(indexes=None)
        stamps = found['stamp']
        for channel in np.unique(found['channel']).tolist():
            self.described.need(channel, chunk.offset)
        if chunk.indexes is None:
            self.messages += len(stamps)
        if not len(stamps):
            return chunk._replace(indexes={})
        return chunk._replace(indexes=None, start=int(stamps.min()), end=int(stamps.max()))
