"""MCAP records from bytes: the counterpart of :mod:`agv_motion.bag.mcap.records`.

Nothing that a file says is believed before it is compared with the bytes that are there.
"""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    Buffer = memoryview | bytes

U16, U32, U64 = Struct('<H'), Struct('<I'), Struct('<Q')
_CHUNK_TIMES, _SPAN, _PAIR64 = Struct('<QQQI'), Struct('<QQQQ'), Struct('<QQ')
_TOTALS, _PAIR16 = Struct('<QHIIIIQQ'), Struct('<HQ')


class ChunkHead(NamedTuple):
    """What stands before the content of a chunk."""

    start: int
    """[ns] log time of its first message"""
    end: int
    """[ns] log time of its last message"""
    size: int
    """[bytes] of the content, uncompressed"""
    crc: int
    """CRC-32 of the uncompressed content; 0: not computed"""
    compression: str
    stored: int
    """[bytes] of the content as it is stored"""
    content: int
    """[bytes] where the content begins, from the beginning of the file"""


class Body:
    """Reads the fields of a record one after another."""

    def __init__(self, data: Buffer, path: Path, offset: int) -> None:
        """Start at the first field.

        Args:
            data: The body of the record.
            path: The file, for errors.
            offset: [bytes] where the body lies in the file, for errors.

        """
        self._data, self._path, self._offset = data, path, offset
        self.position = 0

    def unpack(self, form: Struct) -> tuple[int, ...]:
        """Return numbers.

        Raises:
            DamagedBagError: The record ends before them.

        """
        return form.unpack(self._take(form.size))

    def number(self, form: Struct) -> int:
        """Return one number."""
        return self.unpack(form)[0]

    def blob(self) -> Buffer:
        """Return bytes that have their length (four bytes) before them."""
        return self._take(self.number(U32))

    def bytes(self, size: int) -> Buffer:
        """Return the next ``size`` bytes."""
        return self._take(size)

    @property
    def so_far(self) -> Buffer:
        """What was read."""
        return self._data[: self.position]

    def text(self) -> str:
        """Return a string."""
        try:
            return bytes(self.blob()).decode()
        except UnicodeDecodeError as error:
            finding = 'text that is not UTF-8'
            raise self.damaged(finding) from error

    def strings(self) -> dict[str, str]:
        """Return a map of strings."""
        inner = Body(self.blob(), self._path, self._offset + self.position)
        entries = {}
        while inner.position < len(inner._data):
            key = inner.text()
            entries[key] = inner.text()
        return entries

    def pairs(self) -> dict[int, int]:
        """Return a map of channel ids to numbers."""
        data = self.blob()
        if len(data) % _PAIR16.size:
            finding = f'a map of {len(data)} bytes, expected a multiple of {_PAIR16.size}'
            raise self.damaged(finding)
        return dict(_PAIR16.iter_unpack(data))

    def damaged(self, finding: str) -> DamagedBagError:
        """Return an error about this place."""
        return DamagedBagError(self._path, self._offset + self.position, finding)

    def _take(self, size: int) -> Buffer:
        end = self.position + size
        if end > len(self._data):
            finding = f'a field of {size} bytes in a record of {len(self._data)}'
            raise self.damaged(finding)
        part = self._data[self.position : end]
        self.position = end
        return part


def walk(data: Buffer, position: int, end: int) -> Iterator[tuple[int, int, int]]:
    """Yield opcode, position of the body and its end, of each whole record in ``data``."""
    unpack, size = records.PREFIX.unpack_from, records.PREFIX.size
    while position + size <= end:
        opcode, length = unpack(data, position)
        body = position + size
        position = body + length
        if position > end:
            return
        yield opcode, body, position


def profile(data: Buffer, path: Path) -> str:
    """Return what the first record of a file says that its messages are; '' if it says nothing."""
    begin = len(records.MAGIC)
    opcode, at, end = next(walk(data, begin, len(data)), (0, begin, begin))
    return Body(data[at:end], path, at).text() if opcode == records.HEADER else ''


def schema(body: Body) -> records.Schema:
    """Return a schema."""
    number = body.number(U16)
    name, encoding = body.text(), body.text()
    return records.Schema(number, name, encoding, bytes(body.blob()))


def channel(body: Body) -> records.Channel:
    """Return a channel."""
    number, schema_id = body.number(U16), body.number(U16)
    topic, encoding = body.text(), body.text()
    return records.Channel(number, schema_id, topic, encoding, body.strings())


def chunk_head(body: Body, at: int) -> ChunkHead:
    """Return the head of a chunk whose record's body begins at byte ``at`` of the file."""
    start, end, size, crc = body.unpack(_CHUNK_TIMES)
    compression, stored = body.text(), body.number(U64)
    return ChunkHead(start, end, size, crc, compression, stored, at + body.position)


def chunk_index(body: Body) -> records.ChunkIndex:
    """Return the index record of a chunk."""
    start, end, offset, length = body.unpack(_SPAN)
    offsets, index_length = body.pairs(), body.number(U64)
    compression, sizes = body.text(), body.unpack(_PAIR64)
    where = start, end, offset, length, offsets, index_length
    return records.ChunkIndex(*where, compression, *sizes)


def statistics(body: Body) -> records.Statistics:
    """Return the totals of a file."""
    messages, schemas, channels, attachments, metadata, chunks, start, end = body.unpack(_TOTALS)
    totals = messages, schemas, channels, attachments, metadata, chunks, start, end
    return records.Statistics(*totals, body.pairs())


def attachment(body: Body) -> records.Attachment:
    """Return an attachment.

    Raises:
        DamagedBagError: Its CRC is not that of its bytes.

    """
    log_time, create_time = body.unpack(_PAIR64)
    name, media_type = body.text(), body.text()
    data = bytes(body.bytes(body.number(U64)))
    found = crc32(body.so_far)
    crc = body.number(U32)
    if crc and crc != found:
        finding = f'the attachment {name:.100} with CRC {found:08x}, expected {crc:08x}'
        raise body.damaged(finding)
    return records.Attachment(log_time, create_time, name, media_type, data)


def metadata(body: Body) -> records.Metadata:
    """Return named strings."""
    return records.Metadata(body.text(), body.strings())


def message_index(body: Body) -> tuple[int, Buffer]:
    """Return the channel, and pairs of log time and offset in the uncompressed chunk."""
    return body.number(U16), body.blob()
