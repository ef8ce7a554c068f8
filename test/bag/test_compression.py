"""Chunks by every compression: back to the byte, and never more memory than announced."""

from __future__ import annotations

import lz4.frame
import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st

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


@EVERY
@pytest.mark.parametrize('change', [-1, 1])
def test_another_size_than_announced_is_damage(name, change):
    stored = compressor(name)(DATA)
    with pytest.raises(ValueError, match='bytes'):
        decompress(name, stored, len(DATA) + change)
    with pytest.raises(ValueError, match=r'bytes|output buffer'):
        decompress_into(name, stored, memoryview(bytearray(len(DATA) + change)))


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
    with pytest.raises(ValueError, match='are allowed'):
        decompress_message(stored, len(DATA) - 1)
    with pytest.raises(ValueError, match='announced'):
        decompress_message(stored[:-50], len(DATA))
    with pytest.raises(ValueError, match='zstd'):
        decompress_message(b'nonsense', 10)
