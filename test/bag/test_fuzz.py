"""Hostile files: an error that names file and byte, in bounded time and memory.

launch_scripts/fuzz/fuzz_bags.py is the long form.
"""

from __future__ import annotations

import time
import tracemalloc
from struct import pack

import fuzz_bags
import pytest
import zstandard

from agv_motion.bag.columns.columns import read_topics
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import chunk_content, records
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import AgvMotionError, ConfigurationError

MOST = 80 << 20
"""[bytes] that refusing a hostile file may take"""
TOPIC = records.Channel(1, 1, '/a', 'cdr', {})


def by_hand(path, text, *rest):
    """Write a file without summary, as someone with bad intentions would."""
    schema = records.Schema(1, 'a_msgs/msg/A', 'ros2msg', text.encode())
    head = (records.MAGIC, records.header('ros2', ''), records.schema(schema))
    path.write_bytes(b''.join((*head, records.channel(TOPIC), *rest)))
    return path


def refused(path):
    """Return the error of reading columns, and that little time and memory were taken."""
    tracemalloc.start()
    begin = time.process_time()
    try:
        with pytest.raises(AgvMotionError) as caught, BagReader(path) as bag:
            read_topics(bag)
        assert tracemalloc.get_traced_memory()[1] < MOST
    finally:
        tracemalloc.stop()
    assert time.process_time() - begin < 2.0
    assert path.name in str(caught.value)
    return caught.value


def test_bags_damaged_at_random_are_read_or_refused():
    assert fuzz_bags.fuzz(20.0, seed=7, rounds=20) > 10


@pytest.mark.parametrize('length', [2**31, 2**32 - 1, 2**63 - 1, 2**63, 2**64 - 1])
def test_lengths_that_cannot_be_anywhere_in_a_file(tmp_path, length):
    data = fuzz_bags.sound(tmp_path, 'none')
    path = tmp_path / 'bag.mcap'
    size = 8 if length >= 2**32 else 4
    for at in range(0, len(data) - size, 61):
        path.write_bytes(data[:at] + length.to_bytes(size, 'little') + data[at + size :])
        fuzz_bags.told(path, lambda: fuzz_bags.messages(path))


@pytest.mark.parametrize('announced', [1 << 27, 1 << 30, 2**63])
def test_a_bomb_is_refused_before_it_is_unpacked(tmp_path, announced, monkeypatch):
    monkeypatch.setattr(chunk_content, 'LARGEST', 1 << 26)  # a machine of 256 MiB
    packed = zstandard.compress(bytes(1 << 27))
    chunk = records.chunk_head((0, 1), (len(packed), announced), 0, 'zstd') + packed
    error = refused(by_hand(tmp_path / 'bomb.mcap', 'int32 x', chunk))
    assert isinstance(error, DamagedBagError)
    assert f'a chunk of {announced} bytes out of {len(packed)}' in str(error)
    assert error.offset > len(records.MAGIC)


@pytest.mark.parametrize('compression', ['', 'lz4', 'zstd'])
def test_a_size_that_no_compression_reaches_is_refused(tmp_path, compression):
    packed = zstandard.compress(bytes(1 << 20))
    chunk = records.chunk_head((0, 1), (len(packed), 1 << 31), 0, compression) + packed
    assert f'a chunk of {1 << 31} bytes' in str(
        refused(by_hand(tmp_path / 'a.mcap', 'int32 x', chunk))
    )


BYTES = 'uint8[] data'


def large(path, size, compression='zstd'):
    """Write a message of zeros, as a camera in the dark does; return the bag."""
    with BagWriter(path, compression=compression) as writer:
        topic = writer.add_topic('/a', 'a_msgs/msg/A', BYTES, type_hash='')
        writer.write(topic, 5, b'\0\1\0\0' + size.to_bytes(4, 'little') + bytes(size))
    return path


@pytest.mark.parametrize(('size', 'compression'), [(30_000_000, 'lz4'), (100_000_000, 'zstd')])
def test_what_shrinks_well_or_is_large_is_read(tmp_path, size, compression):
    with BagReader(large(tmp_path / 'bag', size, compression)) as bag:
        (message,) = bag.messages()
        assert len(message.data) == size + 8
        assert read_topics(bag)['/a'].fields['data'].shape == (1, size)
        assert not bag.problems


def test_a_bomb_that_announces_little_is_stopped_there(tmp_path):
    packed = zstandard.ZstdCompressor(write_content_size=False).compress(bytes(1 << 27))
    chunk = records.chunk_head((0, 1), (len(packed), 100), 0, 'zstd') + packed
    assert 'damaged' in str(refused(by_hand(tmp_path / 'bomb.mcap', 'int32 x', chunk)))


def types(*bodies):
    names = (f'MSG: a_msgs/T{i}\n' for i in range(len(bodies)))
    parts = [name + body for name, body in zip(names, bodies, strict=True)]
    return ('\n' + '=' * 80 + '\n').join(['a_msgs/T0 x', *parts])


HOSTILE = {
    'cyclic': types('a_msgs/T1 x', 'a_msgs/T0 x'),
    'cyclic by a sequence': types('a_msgs/T0[] x'),
    'unfolds without end': types(*(f'a_msgs/T{i + 1}[9] x\n' * 9 for i in range(20)), 'int8 x'),
    'huge array': 'float64[99999999999999999] x',
    'not a definition': '\x00\x01\x02 = = =[[[',
    'long': 'int32 x\n' * 500_000,
    'missing type': 'b_msgs/B b',
}


@pytest.mark.parametrize('text', HOSTILE.values(), ids=HOSTILE.keys())
def test_hostile_definitions(tmp_path, text):
    data = b'\0\1\0\0' + bytes(16)
    message = records.record(records.MESSAGE, pack('<HIQQ', 1, 0, 5, 5), data)
    refused(by_hand(tmp_path / 'hostile.mcap', text, message, records.data_end()))


def test_a_sequence_that_announces_more_than_its_message_has(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', 'a_msgs/msg/A', 'float64[] x', type_hash='')
        writer.write(topic, 5, b'\0\1\0\0\xff\xff\xff\xff' + bytes(12))
    path = tmp_path / 'bag' / 'bag_0.mcap'
    error = refused(path)
    assert isinstance(error, DamagedBagError)
    assert '/a' in str(error)
    assert 'at 5 ns' in str(error)


def test_an_unknown_encoding_is_named(tmp_path):
    path = by_hand(tmp_path / 'a.mcap', 'x')
    path.write_bytes(path.read_bytes().replace(b'ros2msg', b'ros9msg'))
    assert isinstance(refused(path), ConfigurationError)
