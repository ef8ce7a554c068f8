"""MCAP records as bytes: the grammar of the file format, one function per kind of record.

Every record is an opcode, a length of eight bytes and a body; all numbers little-endian.
Source: MCAP file format specification, https://mcap.dev/spec
"""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.mcap.checksum import crc32

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

MAGIC = b'\x89MCAP0\r\n'

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
ATTACHMENT, ATTACHMENT_INDEX, STATISTICS, METADATA, METADATA_INDEX = range(9, 14)
SUMMARY_OFFSET, DATA_END = 14, 15

PREFIX = Struct('<BQ')
"""Opcode and length of the body, before every record."""
MESSAGE_HEAD = Struct('<BQHIQQ')
"""Prefix of a message with its channel, sequence, log time and publish time [ns]."""
FOOTER_LENGTH = PREFIX.size + 20

_U16, _U32, _U64 = Struct('<H'), Struct('<I'), Struct('<Q')
_PAIR16, _PAIR64, _CHUNK_TIMES = Struct('<HQ'), Struct('<QQ'), Struct('<QQQI')
_WHERE = Struct('<QQQQQ')
_SPAN, _TOTALS, _FOOT = Struct('<QQQQ'), Struct('<QHIIIIQQ'), Struct('<BQQQ')


class Schema(NamedTuple):
    """What the messages of some channels look like."""

    id: int
    name: str
    encoding: str
    data: bytes


class Channel(NamedTuple):
    """One topic of the file."""

    id: int
    schema_id: int
    topic: str
    encoding: str
    metadata: Mapping[str, str]


class ChunkIndex(NamedTuple):
    """Where a chunk lies, what time it spans and where the index of each channel follows it."""

    start_time: int
    end_time: int
    offset: int
    length: int
    index_offsets: Mapping[int, int]
    index_length: int
    compression: str
    compressed_size: int
    uncompressed_size: int


class Attachment(NamedTuple):
    """A file within the file, such as a calibration."""

    log_time: int
    create_time: int
    name: str
    media_type: str
    data: bytes


class Metadata(NamedTuple):
    """Named strings."""

    name: str
    entries: Mapping[str, str]


class Statistics(NamedTuple):
    """Totals of the file."""

    messages: int
    schemas: int
    channels: int
    attachments: int
    metadata: int
    chunks: int
    start_time: int
    end_time: int
    channel_messages: Mapping[int, int]


def record(opcode: int, *body: bytes) -> bytes:
    """Return a record with its prefix."""
    joined = b''.join(body)
    return PREFIX.pack(opcode, len(joined)) + joined


def text(value: str) -> bytes:
    """Return a string with its length before it."""
    return blob(value.encode())


def blob(value: bytes) -> bytes:
    """Return bytes with their length (four bytes) before them."""
    return _U32.pack(len(value)) + value


def header(profile: str, library: str) -> bytes:
    """Return the first record of a file."""
    return record(HEADER, text(profile), text(library))


def schema(value: Schema) -> bytes:
    """Return a schema record."""
    name, encoding = text(value.name), text(value.encoding)
    return record(SCHEMA, _U16.pack(value.id), name, encoding, blob(value.data))


def channel(value: Channel) -> bytes:
    """Return a channel record."""
    head = _U16.pack(value.id), _U16.pack(value.schema_id), text(value.topic), text(value.encoding)
    return record(CHANNEL, *head, blob(_strings(value.metadata)))


def chunk_head(times: tuple[int, int], sizes: tuple[int, int], crc: int, compression: str) -> bytes:
    """Return what comes before the content of a chunk, its prefix included.

    Args:
        times: [ns] log time of the first and the last message.
        sizes: [bytes] of the content as it is stored and uncompressed.
        crc: CRC-32 of the uncompressed content.
        compression: '', 'lz4' or 'zstd'.

    """
    stored, size = sizes
    head = _CHUNK_TIMES.pack(*times, size, crc) + text(compression) + _U64.pack(stored)
    return PREFIX.pack(CHUNK, len(head) + stored) + head


def message_index(channel_id: int, entries: bytes) -> bytes:
    """Return where the messages of a channel lie: ``entries`` are pairs of log time and offset."""
    return record(MESSAGE_INDEX, _U16.pack(channel_id), blob(entries))


def chunk_index(value: ChunkIndex) -> bytes:
    """Return the index record of a chunk."""
    return record(
        CHUNK_INDEX,
        _SPAN.pack(value.start_time, value.end_time, value.offset, value.length),
        blob(_pairs(value.index_offsets.items())),
        _U64.pack(value.index_length),
        text(value.compression),
        _PAIR64.pack(value.compressed_size, value.uncompressed_size),
    )


def statistics(value: Statistics) -> bytes:
    """Return the totals of the file."""
    pairs = _pairs(value.channel_messages.items())
    return record(STATISTICS, _TOTALS.pack(*value[:8]), blob(pairs))


def attachment(value: Attachment) -> bytes:
    """Return an attachment with its CRC."""
    head = _PAIR64.pack(value.log_time, value.create_time), text(value.name), text(value.media_type)
    body = b''.join((*head, _U64.pack(len(value.data)), value.data))
    return record(ATTACHMENT, body, _U32.pack(crc32(body)))


def attachment_index(value: Attachment, offset: int, length: int) -> bytes:
    """Return where an attachment lies, and what it is."""
    where = offset, length, value.log_time, value.create_time, len(value.data)
    return record(ATTACHMENT_INDEX, _WHERE.pack(*where), text(value.name), text(value.media_type))


def metadata(value: Metadata) -> bytes:
    """Return named strings as a record."""
    return record(METADATA, text(value.name), blob(_strings(value.entries)))


def metadata_index(offset: int, length: int, name: str) -> bytes:
    """Return where a metadata record lies."""
    return record(METADATA_INDEX, _PAIR64.pack(offset, length), text(name))


def data_end(crc: int = 0) -> bytes:
    """Return the end of the data section; ``crc`` 0 means that it was not computed."""
    return record(DATA_END, _U32.pack(crc))


def summary_offset(opcode: int, start: int, length: int) -> bytes:
    """Return where a group of equal records lies in the summary."""
    return record(SUMMARY_OFFSET, bytes((opcode,)), _PAIR64.pack(start, length))


def footer_head(summary_start: int, summary_offset_start: int) -> bytes:
    """Return the footer up to its CRC, which covers the summary and these bytes."""
    return _FOOT.pack(FOOTER, 20, summary_start, summary_offset_start)


def checksum(crc: int) -> bytes:
    """Return a CRC as it stands in the file."""
    return _U32.pack(crc)


def _strings(entries: Mapping[str, str]) -> bytes:
    return b''.join(text(key) + text(value) for key, value in entries.items())


def _pairs(entries: Iterable[tuple[int, int]]) -> bytes:
    return b''.join(_PAIR16.pack(*entry) for entry in entries)
