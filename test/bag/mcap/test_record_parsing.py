"""Records written and read back, and what is told where bytes are missing."""

from __future__ import annotations

from pathlib import Path

import pytest

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import record_parsing as parsing
from agv_motion.bag.mcap import records

PATH = Path('walk.mcap')
PAIRS = [
    (records.schema, parsing.schema, records.Schema(3, 'a/msg/A', 'ros2msg', b'int8 x')),
    (
        records.channel, parsing.channel,
        records.Channel(2, 3, '/a', 'cdr', {'offered_qos_profiles': '', 'note': 'ü'}),
    ),
    (
        records.chunk_index, parsing.chunk_index,
        records.ChunkIndex(1, 9, 40, 700, {1: 740, 2: 790}, 99, 'zstd', 600, 1200),
    ),
    (
        records.statistics, parsing.statistics,
        records.Statistics(7, 1, 2, 3, 4, 5, 10, 20, {1: 4, 2: 3}),
    ),
    (
        records.attachment, parsing.attachment,
        records.Attachment(5, 6, 'turrets.yaml', 'text/yaml', b'radius: 0.1'),
    ),
    (records.metadata, parsing.metadata, records.Metadata('rosbag2', {'a': 'b', 'c': ''})),
]  # fmt: skip
NAMES = [value.__class__.__name__ for *_, value in PAIRS]


def body(data, offset=0):
    ((_, begin, end),) = parsing.walk(data, 0, len(data))
    return parsing.Body(data[begin:end], PATH, offset + begin)


@pytest.mark.parametrize(('write', 'read', 'value'), PAIRS, ids=NAMES)
def test_what_is_written_is_read(write, read, value):
    assert read(body(write(value))) == value


@pytest.mark.parametrize(('write', 'read', 'value'), PAIRS, ids=NAMES)
def test_a_record_that_is_cut_short_is_damage_at_its_place(write, read, value):
    data = write(value)
    for left in range(records.PREFIX.size, len(data)):
        short = parsing.Body(data[records.PREFIX.size : left], PATH, 1000)
        with pytest.raises(DamagedBagError, match=r'walk\.mcap'):
            read(short)


def test_the_walk_ends_with_the_last_whole_record():
    data = records.data_end() + records.header('ros2', 'us') + records.data_end()
    whole = [opcode for opcode, _, _ in parsing.walk(data, 0, len(data))]
    assert whole == [records.DATA_END, records.HEADER, records.DATA_END]
    assert len(list(parsing.walk(data, 0, len(data) - 1))) == 2
    assert not list(parsing.walk(data, 0, 8))


def test_a_wrong_byte_in_an_attachment_is_told_by_its_crc():
    data = bytearray(records.attachment(records.Attachment(5, 6, 'a', 'b', b'content')))
    data[-6] ^= 1
    with pytest.raises(DamagedBagError, match='the attachment a with CRC'):
        parsing.attachment(body(bytes(data)))
    data[-4:] = bytes(4)  # nobody computed one
    assert parsing.attachment(body(bytes(data))).data != b'content'


def test_text_that_is_none_and_maps_that_do_not_divide_are_damage():
    with pytest.raises(DamagedBagError, match='text that is not UTF-8'):
        parsing.Body(records.blob(b'\xff'), PATH, 0).text()
    with pytest.raises(DamagedBagError, match='a map of 11 bytes, expected a multiple of 10'):
        parsing.Body(records.blob(bytes(11)), PATH, 0).pairs()


def test_the_head_of_a_chunk_says_where_its_content_begins():
    data = records.chunk_head((1, 9), (5, 12), 0xABCD, 'lz4') + b'12345'
    head = parsing.chunk_head(body(data, 200), 200 + records.PREFIX.size)
    assert head == (1, 9, 12, 0xABCD, 'lz4', 5, 200 + len(data) - 5)


def test_a_message_index_is_its_channel_and_pairs():
    channel, entries = parsing.message_index(body(records.message_index(4, b'x' * 16)))
    assert (channel, bytes(entries)) == (4, b'x' * 16)


def test_the_profile_is_what_the_first_record_says():
    header, other = records.header('ros2', 'us'), records.data_end()
    for data, expected in (
        (header, 'ros2'),
        (header + other, 'ros2'),
        (other + header, ''),
        (b'', ''),
    ):
        assert parsing.profile(records.MAGIC + data, PATH) == expected
