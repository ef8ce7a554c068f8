"""The content of chunks and their messages: whole, damaged, torn, or lying about their size."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from agv_motion.bag.compression import compressor
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.chunk import Chunk
from agv_motion.bag.mcap.chunk_content import content, message_offsets
from agv_motion.bag.mcap.message_heads import heads

PATH = Path('walk.mcap')
EVERY = pytest.mark.parametrize('compression', ['', 'lz4', 'zstd'])


def message(channel, stamp, data, sequence=0):
    length = records.MESSAGE_HEAD.size - records.PREFIX.size + len(data)
    head = records.MESSAGE_HEAD.pack(records.MESSAGE, length, channel, sequence, stamp, stamp + 1)
    return head + data


CONTENT = message(1, 5, b'abc', 7) + message(2, 6, b'') + message(1, 9, b'defgh' * 20)


def file_with(compression='', *, crc=None, size=None, before=b'....'):
    stored = compressor(compression)(CONTENT)
    crc = crc32(CONTENT) if crc is None else crc
    size = len(CONTENT) if size is None else size
    head = records.chunk_head((5, 9), (len(stored), size), crc, compression)
    record = head + stored
    return memoryview(before + record), Chunk(len(before), len(record), 5, 9, size, None)


@EVERY
def test_what_was_stored_comes_out(compression):
    data, chunk = file_with(compression)
    assert bytes(content(data, chunk, PATH, validate=True)) == CONTENT
    target = memoryview(bytearray(len(CONTENT)))
    content(data, chunk, PATH, validate=True, target=target)
    assert bytes(target) == CONTENT


@EVERY
def test_another_crc_is_damage_unless_nobody_computed_or_asks_for_it(compression):
    data, chunk = file_with(compression, crc=1)
    with pytest.raises(DamagedBagError, match='expected 00000001'):
        content(data, chunk, PATH, validate=True)
    assert bytes(content(data, chunk, PATH, validate=False)) == CONTENT
    data, chunk = file_with(compression, crc=0)
    assert bytes(content(data, chunk, PATH, validate=True)) == CONTENT


@EVERY
def test_who_announces_more_than_can_be_lies(compression):
    data, chunk = file_with(compression, size=1 << 40)
    with pytest.raises(DamagedBagError, match=f'a chunk of {1 << 40} bytes out of'):
        content(data, chunk, PATH, validate=True)


def test_a_chunk_that_ends_elsewhere_is_damage():
    data, chunk = file_with()
    with pytest.raises(DamagedBagError, match='expected'):
        content(data, chunk._replace(length=chunk.length - 1), PATH, validate=True)


@pytest.mark.parametrize('compression', ['', 'lz4', 'zstd'])
def test_of_a_torn_chunk_whole_messages_are_saved(compression):
    data, chunk = file_with(compression)
    torn = chunk._replace(length=chunk.length - 1, torn=True)
    saved = content(data[: len(data) - 1], torn, PATH, validate=True)
    assert CONTENT.startswith(bytes(saved))
    if not compression:
        assert len(message_offsets(saved)) == 2


def test_a_bare_stretch_is_its_own_content():
    data = memoryview(b'....' + CONTENT + b'....')
    stretch = Chunk(4, len(CONTENT), 5, 9, len(CONTENT), None, bare=True)
    assert bytes(content(data, stretch, PATH, validate=True)) == CONTENT
    assert not stretch.unindexed
    assert stretch._replace(bare=False).unindexed


def test_messages_by_a_walk_and_their_heads():
    offsets = message_offsets(CONTENT + b'\x05\x01')
    assert offsets.tolist() == [0, 34, 65]
    found = heads(CONTENT, offsets)
    assert found['channel'].tolist() == [1, 2, 1]
    assert found['sequence'].tolist() == [7, 0, 0]
    assert found['stamp'].tolist() == [5, 6, 9]
    assert found['publish'].tolist() == [6, 7, 10]
    assert not len(heads(CONTENT, np.empty(0, np.int64)))


@pytest.mark.parametrize('offset', [1, 33, len(CONTENT) - 5, len(CONTENT), 1 << 40])
def test_a_place_without_a_whole_message_is_refused(offset):
    with pytest.raises(ValueError, match='message at byte'):
        heads(CONTENT, np.array([0, offset]))
    with pytest.raises(ValueError, match='no whole message at byte 65'):
        heads(CONTENT[:-1], np.array([65]))


def test_how_many_messages_indexes_tell_of():
    """Each is 15 bytes and 16 for every message."""
    chunk = Chunk(0, 100, 5, 9, 50, {1: 100, 2: 147}, index_length=2 * 15 + 3 * 16)
    assert chunk.indexed_messages == 3
    assert chunk.filled
    assert not chunk._replace(indexes={}).filled
    assert chunk._replace(indexes=None).filled
    assert chunk._replace(indexes=None).indexed_messages == 0


def test_a_compression_that_is_none_of_mcap_is_named():
    data, chunk = file_with('zstd')
    data = memoryview(bytes(data).replace(b'zstd', b'zlib', 1))
    with pytest.raises(DamagedBagError, match="a chunk compressed by 'zlib', expected '', 'lz4'"):
        content(data, chunk, PATH, validate=True)
