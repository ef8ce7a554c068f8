"""What an MCAP file holds, by walking through it: for files without index, torn or not chunked."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag import record_parsing as parsing
from agv_motion.bag import records
from agv_motion.bag.chunk import HEAD, Chunk, content
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap_summary import Summary

if TYPE_CHECKING:
    from pathlib import Path

STRETCH = 1 << 22
"""[bytes] Messages outside chunks are taken together up to this size."""
_SHORTEST_MESSAGE = HEAD.itemsize - records.PREFIX.size
_U16_SIZE = parsing.U16.size


def scan(data: memoryview, path: Path) -> Summary:
    """Return what the file holds up to its last whole record, and the chunk torn after it."""
    walk = _Walk(data, path)
    walk.through()
    return Summary(walk.schemas, walk.channels, walk.chunks, None, walk.problems, indexed=False)


class _Walk:
    """A walk through the data section."""

    def __init__(self, data: memoryview, path: Path) -> None:
        self._data, self._path = data, path
        self.schemas: dict[int, records.Schema] = {}
        self.channels: dict[int, records.Channel] = {}
        self.chunks: list[Chunk] = []
        self.problems: list[DamagedBagError] = []

    def through(self) -> None:
        """Walk from the first record to the end of the data, or to where the file is torn."""
        position = len(records.MAGIC)
        whole = False
        for opcode, at, end in parsing.walk(self._data, position, len(self._data)):
            whole = opcode == records.DATA_END
            try:
                self._record(opcode, at, end)
            except DamagedBagError as error:
                self.problems.append(error)
            position = end
            if whole:
                break
        if not whole:
            self._torn(position)
        self._learn()

    def _record(self, opcode: int, at: int, end: int) -> None:
        if opcode == records.SCHEMA:
            schema = parsing.schema(parsing.Body(self._data[at:end], self._path, at))
            self.schemas.setdefault(schema.id, schema)
        elif opcode == records.CHANNEL:
            channel = parsing.channel(parsing.Body(self._data[at:end], self._path, at))
            self.channels.setdefault(channel.id, channel)
        elif opcode == records.CHUNK:
            self._chunk(at, end)
        elif opcode == records.MESSAGE_INDEX and self.chunks and end - at >= _U16_SIZE:
            (channel_id,) = parsing.U16.unpack_from(self._data, at)
            chunk = self.chunks[-1]
            indexes = {**(chunk.indexes or {}), channel_id: at - records.PREFIX.size}
            self.chunks[-1] = chunk._replace(indexes=indexes)
        elif opcode == records.MESSAGE and end - at >= _SHORTEST_MESSAGE:
            self._message(at - records.PREFIX.size, end)

    def _chunk(self, at: int, end: int) -> None:
        head = parsing.chunk_head(parsing.Body(self._data[at:end], self._path, at), at)
        offset = at - records.PREFIX.size
        self.chunks.append(Chunk(offset, end - offset, head.start, head.end, head.size, None))

    def _message(self, offset: int, end: int) -> None:
        """Add a message outside chunks to the stretch before it, or begin another stretch."""
        stamp = records.MESSAGE_HEAD.unpack_from(self._data, offset)[4]
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
        """Look for channels where writers put them: into chunks, before their first message."""
        for number, chunk in enumerate(self.chunks):
            if chunk.indexes and all(channel in self.channels for channel in chunk.indexes):
                continue
            if chunk.bare:
                continue
            try:
                inside = content(self._data, chunk, self._path, validate=False)
                self._inside(inside, chunk)
            except DamagedBagError as error:
                self.problems.append(error)
            if any(channel not in self.channels for channel in chunk.indexes or ()):
                self.chunks[number] = chunk._replace(indexes=None)

    def _inside(self, inside: parsing.Buffer, chunk: Chunk) -> None:
        for opcode, at, end in parsing.walk(inside, 0, len(inside)):
            if opcode in (records.SCHEMA, records.CHANNEL):
                body = parsing.Body(inside[at:end], self._path, chunk.offset)
                if opcode == records.SCHEMA:
                    schema = parsing.schema(body)
                    self.schemas.setdefault(schema.id, schema)
                else:
                    channel = parsing.channel(body)
                    self.channels.setdefault(channel.id, channel)
