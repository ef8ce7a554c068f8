"""Chunks by every compression: back to the byte, and never more memory than announced."""

from __future__ import annotations

import lz4.frame
import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.bag import compression
from agv_motion.bag.compression import (
    compressor,
    decompress,
    decompress_into,
    decompress_message,
    salvage,
)
from agv_motion.errors import ConfigurationError

NAMES = ('', 'lz4', 'zstd')
EVERY = pytest.mark.parametrize('name', NAMES)
DATA = bytes(range(256)) * 2000


@settings(max_examples=30)
@given(st.sampled_from(NAMES), st.binary(max_size=400))
def test_there_and_back(name, data):
    stored = compressor(name)(data)
    assert bytes(decompress(name, stored, len(data))) == data
    target = bytearray(len(data))
    decompress_into(name, stored, memoryview(target))
    assert target == data


def test_zstd_takes_the_level_that_keeps_up_with_a_link():
    text = b''.join(b'%d,' % (k * k) for k in range(3000))
    levels = [zstandard.ZstdCompressor(level=level).compress(text) for level in (1, 2)]
    assert compressor('zstd')(text) == levels[0] != levels[1]


@EVERY
@pytest.mark.parametrize('change', [-2, -1, 1])
def test_another_size_than_announced_is_damage(name, change):
    stored, size = compressor(name)(DATA), len(DATA) + change
    comes = 'a frame of 512000' if name == 'zstd' and change < 0 else min(512000, size + 1)
    with pytest.raises(ValueError, match=f'{comes if name else 512000} bytes where {size} were'):
        decompress(name, stored, size)
    with pytest.raises(ValueError, match=r'bytes|output buffer'):
        decompress_into(name, stored, memoryview(bytearray(size)))


def test_frames_of_zstd_one_after_the_other_or_that_hide_their_size():
    hidden = zstandard.ZstdCompressor(write_content_size=False).compress(DATA)
    for stored, size in ((zstandard.compress(DATA) * 2, 1024000), (hidden, 512000)):
        assert decompress('zstd', stored, size) == DATA * (size // 512000)
        target = bytearray(size)
        decompress_into('zstd', stored, memoryview(target))
        assert target == DATA * (size // 512000)
        with pytest.raises(ValueError, match=f'{size - 4} bytes where {size - 5} were announced'):
            decompress('zstd', stored, size - 5)
    with pytest.raises(ValueError, match='output buffer being full'):
        decompress_into('zstd', zstandard.compress(DATA) * 2, memoryview(bytearray(512000)))
    assert salvage('zstd', zstandard.compress(DATA) * 2, 600000) == (DATA * 2)[:600000]


def test_a_large_chunk_of_lz4_takes_memory_only_for_what_comes_out(monkeypatch):
    monkeypatch.setattr(compression, '_AT_ONCE', 1000)
    stored = lz4.frame.compress(DATA)
    assert decompress('lz4', stored, 512000) == DATA
    for size, comes in ((511995, 511996), (512005, 512000)):
        with pytest.raises(ValueError, match=f'^{comes} bytes where {size} were announced'):
            decompress('lz4', stored, size)


@pytest.mark.parametrize('name', ['lz4', 'zstd'])
def test_bytes_that_are_none_are_damage(name):
    with pytest.raises(ValueError, match=name):
        decompress(name, b'nonsense of no kind', 5)


@EVERY
def test_of_a_torn_chunk_its_beginning_is_saved(name):
    stored = compressor(name)(DATA)
    saved = salvage(name, stored[: len(stored) // 2], len(DATA))
    assert DATA.startswith(saved)
    assert len(saved) < len(DATA)
    assert salvage(name, stored, 1000) == DATA[:1000]


def test_a_torn_frame_without_announced_size_gives_what_came_before():
    """Blocks of 64 kB, each a whole of its own."""
    frame = lz4.frame.compress(DATA, block_size=lz4.frame.BLOCKSIZE_MAX64KB)
    assert len(salvage('lz4', frame[:-100], len(DATA))) >= len(DATA) // 2
    assert salvage('lz4', b'nonsense', 10) == b''


def test_unknown_names_are_told_with_those_that_there_are():
    with pytest.raises(ConfigurationError, match="'gzip': choose one of 'zstd', 'lz4', 'none'"):
        compressor('gzip')
    with pytest.raises(ValueError, match="'gzip', expected '', 'lz4' or 'zstd'"):
        decompress('gzip', b'', 0)


def test_a_message_that_was_compressed_by_itself():
    stored = zstandard.compress(DATA)
    assert decompress_message(stored, len(DATA)) == DATA
    text = '511996 bytes where 512000 were announced and 511995 are allowed'
    with pytest.raises(ValueError, match=text):
        decompress_message(stored, len(DATA) - 5)
    with pytest.raises(ValueError, match='announced'):
        decompress_message(stored[:-50], len(DATA))
    with pytest.raises(ValueError, match='zstd'):
        decompress_message(b'nonsense', 10)
