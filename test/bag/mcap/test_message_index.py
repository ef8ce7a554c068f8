"""Message indexes that are not true: they have no CRC, so they are compared with the messages."""

from __future__ import annotations

import io
import random
from pathlib import Path
from struct import pack, pack_into, unpack_from

import pytest
from mcap.writer import CompressionType, Writer

from agv_motion.bag.checks.stamps import stamps
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import message_index, records
from agv_motion.bag.mcap.record_parsing import walk
from agv_motion.bag.reader import BagReader


def file_of(rows, **options):
    """Return a file with messages of topics (0 or 1) and times [ns], a few in a chunk."""
    stream = io.BytesIO()
    writer = Writer(stream, 150, CompressionType.NONE, **options)
    writer.start('ros2', '')
    schema = writer.register_schema('a/msg/A', 'ros2msg', b'uint32 x')
    topics = [writer.register_channel(name, 'cdr', schema) for name in ('/a', '/b')]
    for topic, time in rows:
        writer.add_message(topics[topic], time, b'\0\1\0\0\0\0\0\0', time, 0)
    writer.finish()
    return bytearray(stream.getvalue())


def found(data, opcode):
    """Return where the bodies of records of a kind begin and end."""
    return [(at, end) for o, at, end in walk(data, len(records.MAGIC), len(data)) if o == opcode]


def opened(tmp_path, data):
    path = tmp_path / 'a.mcap'
    path.write_bytes(data)
    return BagReader(path)


ROWS = [(i % 2, 1000 + 7 * i) for i in range(24)]


def test_a_time_that_is_not_that_of_the_message(tmp_path):
    data = file_of(ROWS)
    at, _ = found(data, records.MESSAGE_INDEX)[0]
    pack_into('<Q', data, at + 6, unpack_from('<Q', data, at + 6)[0] + 1)
    with opened(tmp_path, data) as bag:
        with pytest.raises(DamagedBagError, match='not those of its index'):
            list(bag.messages())
        with pytest.raises(DamagedBagError, match='not those of the index'):
            read_topic(bag, '/a')
        assert len(list(bag.messages(['/b']))) == 12


def test_a_time_outside_of_its_chunk_is_seen_without_unpacking(tmp_path):
    data = file_of(ROWS)
    at, _ = found(data, records.MESSAGE_INDEX)[0]
    data[at + 6 + 7] ^= 1
    with opened(tmp_path, data) as bag, pytest.raises(DamagedBagError, match='times outside'):
        stamps(bag)


def test_an_index_that_tells_of_fewer_messages_than_it_has_room_for(tmp_path):
    data = file_of(ROWS)
    at, _ = found(data, records.MESSAGE_INDEX)[0]
    pack_into('<I', data, at + 2, unpack_from('<I', data, at + 2)[0] - 16)
    with opened(tmp_path, data) as bag, pytest.raises(DamagedBagError, match='in a record of'):
        list(bag.messages(['/a']))


def test_without_a_chunk_no_message_of_another_topic_is_given_out(tmp_path):
    """The index of a chunk that is gone is taken for that of the one before."""
    rng = random.Random(1)  # noqa: S311
    data = file_of([(rng.randrange(2), 1000 + 7 * i) for i in range(24)])
    at, end = found(data, records.CHUNK)[2]
    del data[at - records.PREFIX.size : end]
    with opened(tmp_path, data) as bag:
        assert bag.lossy
        for topic in ('/a', '/b'):
            with pytest.raises(DamagedBagError):
                list(bag.messages([topic]))


@pytest.mark.parametrize('bit', range(8))
def test_a_bit_outside_of_chunks_is_seen_by_the_crc_of_the_data(tmp_path, bit):
    data = file_of(ROWS, use_chunking=False, enable_data_crcs=True)
    with opened(tmp_path, data) as bag:
        assert not bag.problems
        bag.files[0].require_whole()
    at, _ = found(data, records.MESSAGE)[5]
    data[at + 2 + 4 + 2 * bit] ^= 1 << bit
    with opened(tmp_path, data) as bag:
        (problem,) = bag.problems
        with pytest.raises(DamagedBagError, match='all bytes before have CRC'):
            bag.files[0].require_whole()
        assert bag.lossy
    end, _ = found(data, records.DATA_END)[0]
    assert f'byte {end - records.PREFIX.size}: all bytes before have CRC' in str(problem)


@pytest.mark.parametrize('longer', [1, 4])
def test_a_message_that_reaches_over_the_end_of_its_chunk(tmp_path, longer):
    """Into the next chunk, which is decoded beside it."""
    data = file_of(ROWS)
    at, end = found(data, records.CHUNK)[0]
    (length,) = unpack_from('<Q', data, end - 30 - records.PREFIX.size + 1)
    assert length == 30
    pack_into('<Q', data, end - 30 - 8, length + longer)
    data[at + 24 : at + 28] = bytes(4)  # a CRC of 0 says that there is none
    (channel,) = unpack_from('<H', data, end - 30)
    with opened(tmp_path, data) as bag, pytest.raises(DamagedBagError, match='of the index'):
        read_topic(bag, ('/a', '/b')[channel - 1])


PATH = Path('x.mcap')
INDEX = b'....' + records.message_index(3, pack('<4Q', 5, 0, 9, 40))
"""Of channel 3, with two messages, from byte 4 on: a record of 38 bytes behind its prefix."""


def other(length, size, more=b''):
    """Return that index with other lengths of the record and of its entries."""
    return b'....' + pack('<BQHI', records.MESSAGE_INDEX, length, 3, size) + INDEX[19:] + more


def test_rows_are_time_and_place_of_each_message():
    assert message_index.rows(INDEX, 3, 4, PATH).tolist() == [[5, 0], [9, 40]]
    assert message_index.rows(b'....' + records.message_index(3, b''), 3, 4, PATH).shape == (0, 2)
    assert message_index.rows(other(53, 32, bytes(15)), 3, 4, PATH).tolist() == [[5, 0], [9, 40]]


@pytest.mark.parametrize(('data', 'channel', 'at', 'finding'), [
    (INDEX, 3, 37, 'a message index at byte 37 of a file of 51'),
    (INDEX, 3, 36, 'no message index where the summary says'),
    (INDEX, 3, 3, 'no message index where the summary says'),
    (INDEX[:-1], 3, 4, 'no message index where the summary says'),
    (INDEX, 4, 4, 'channel 3 with 32 bytes in a record of 38, expected channel 4'),
    (other(38, 31), 3, 4, 'channel 3 with 31 bytes in a record of 38, expected channel 3'),
    (other(38, 48), 3, 4, 'channel 3 with 48 bytes in a record of 38, expected channel 3'),
    (other(54, 32, bytes(16)), 3, 4, 'channel 3 with 32 bytes in a record of 54, expected'),
])  # fmt: skip
def test_what_is_no_such_index_is_told_with_its_place(data, channel, at, finding):
    with pytest.raises(DamagedBagError) as caught:
        message_index.rows(data, channel, at, PATH)
    assert str(caught.value).startswith(f'x.mcap, byte {at}: ')
    assert finding in str(caught.value)


def test_how_many_messages_there_are_at_most():
    assert message_index.most(INDEX, 4) == 38 // 16
    assert message_index.most(INDEX[:13], 4) == 13 // 16
    assert message_index.most(INDEX[:12], 4) == 0
    assert message_index.most(other(2**60, 32), 4) == len(INDEX) // 16
