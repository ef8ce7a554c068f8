"""Recovery: a bag cut off at every byte, damaged chunks, topics that changed their type."""

from __future__ import annotations

import os

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer as McapLibraryWriter
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.bag_files import find
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError

TEXT = 'std_msgs/msg/String'
MAGIC = 8
END = 40
"""[bytes] of a file's footer and magic, and a little more"""


def small(path, compression='none', count=12, chunk_size=200):
    """Write a small bag; return its file."""
    with BagWriter(path, compression=compression, chunk_size=chunk_size) as writer:
        topics = [
            writer.add_topic(name, TEXT, 'string data', type_hash='', qos=())
            for name in ('/a', '/b')
        ]
        for i in range(count):
            data = b'\x00\x01\x00\x00\x05\x00\x00\x00tex' + bytes([65 + i, 0])
            writer.write(topics[i % 2], i + 1, data, i + 2, i)
    return path / f'{path.name}_0.mcap'


def contents(path):
    with BagReader(path) as bag:
        return [
            (m.connection.topic, m.stamp, m.publish, m.sequence, m.data) for m in bag.messages()
        ]


def recovered(damaged, saved):
    with BagWriter(saved) as writer:
        recovery = Recovery(writer)
        recovery.save(damaged)
    return recovery


def cut_off(file, sizes):
    """Yield each size, the longest first, with a file that ends there: ever more is cut off one."""
    cut = file.parents[1] / 'cut.mcap'  # beside the bag, whose metadata says nothing of it
    cut.write_bytes(file.read_bytes())
    for size in sorted(sizes, reverse=True):
        os.truncate(cut, size)
        yield size, cut


def whole_messages(data):
    """Return how many messages end in the bytes of an uncompressed file, by their signature."""
    count = at = 0
    while (at := data.find(b'tex', at)) >= 0:
        count += at + 5 <= len(data)
        at += 1
    return count


def test_a_file_cut_off_at_every_byte_is_read_up_to_its_last_whole_message(tmp_path):
    """At every byte up to its last index and of its end, and at every ninth between."""
    file = small(tmp_path / 'bag', count=6)
    data, every = file.read_bytes(), contents(file)
    indexed = data.rfind(b'tex') + 150
    summary = range(indexed, len(data) - END, 9)
    for size, cut in cut_off(file, {*range(indexed), *summary, *range(len(data))[-END:]}):
        if size < MAGIC:
            with pytest.raises(SourceError):
                BagReader(cut)
            continue
        found = contents(cut)
        assert found == every[: whole_messages(data[:size])], size


@pytest.mark.parametrize('compression', ['zstd', 'lz4'])
def test_a_compressed_file_cut_off_at_every_seventh_byte_keeps_its_whole_chunks(
    tmp_path, compression
):
    file = small(tmp_path / 'bag', compression, count=4)
    with BagReader(file) as bag:
        ends = [chunk.offset + chunk.length for chunk in bag.files[0].chunks]
    every = contents(file)
    each = len(every) // len(ends)
    for size, cut in cut_off(file, range(MAGIC, file.stat().st_size, 7)):
        found = contents(cut)
        assert found == every[: len(found)]
        assert len(found) >= each * sum(end <= size for end in ends)


def test_what_is_saved_has_an_index_that_others_read(tmp_path):
    file = small(tmp_path / 'bag')
    data, every = file.read_bytes(), contents(file)
    for number, size in enumerate(range(300, len(data), 97)):
        cut = tmp_path / 'cut.mcap'
        cut.write_bytes(data[:size])
        saved = tmp_path / f'saved_{number}'
        expected = every[: whole_messages(data[:size])]
        recovery = recovered(cut, saved)
        assert recovery.messages == len(expected)
        assert contents(saved) == expected
        with (saved / f'{saved.name}_0.mcap').open('rb') as stream:
            reader = make_reader(stream, validate_crcs=True)
            assert reader.get_summary().statistics.message_count == len(expected)
            read = [(c.topic, m.log_time) for _, c, m in reader.iter_messages()]
        assert read == [message[:2] for message in expected]


def test_a_damaged_chunk_is_left_out_and_told(tmp_path):
    file = small(tmp_path / 'bag')
    data, every = bytearray(file.read_bytes()), contents(file)
    data[data.find(b'texE')] ^= 1
    file.write_bytes(data)
    recovery = recovered(tmp_path / 'bag', tmp_path / 'saved')
    (problem,) = recovery.problems
    assert isinstance(problem, DamagedBagError)
    assert 'CRC' in str(problem)
    found = contents(tmp_path / 'saved')
    assert set(found) < set(every)
    assert len(every) - len(found) < 6
    assert not any(b'texE' in message[-1] for message in found)


def test_files_that_cannot_be_read_at_all_do_not_stop_the_others(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', TEXT, 'string data', type_hash='')
        for i in range(3):
            writer.write(topic, i, b'\x00\x01\x00\x00\x01\x00\x00\x00\x00')
            if i < 2:
                writer.split()
    find(tmp_path / 'bag').paths[1].write_bytes(b'')
    recovery = recovered(tmp_path / 'bag', tmp_path / 'saved')
    assert [message[1] for message in contents(tmp_path / 'saved')] == [0, 2]
    assert 'bag_1.mcap is empty' in str(recovery.problems[0])


def test_a_topic_that_changed_its_type_keeps_both(tmp_path):
    for number, text in enumerate(('string data', 'string data\nint32 more')):
        with BagWriter(tmp_path / f'part_{number}') as writer:
            topic = writer.add_topic('/a', TEXT, text, type_hash='')
            writer.write(topic, number, b'\x00\x01\x00\x00\x01\x00\x00\x00\x00')
    (tmp_path / 'bag').mkdir()
    for number in range(2):
        file = tmp_path / f'part_{number}' / f'part_{number}_0.mcap'
        file.rename(tmp_path / 'bag' / f'bag_{number}.mcap')
    recovered(tmp_path / 'bag', tmp_path / 'saved')
    with BagReader(tmp_path / 'saved') as bag:
        assert [(c.topic, c.definition) for c in bag.connections] == [
            ('/a', 'string data'),
            ('/a_2', 'string data\nint32 more'),
        ]


def sqlite_bag(path, mode=CompressionMode.NONE, count=2000):
    """Let rosbags write a bag in sqlite3; return its file."""
    store = get_typestore(Stores.ROS2_JAZZY)
    text = store.types[TEXT]
    writer = Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        topic = writer.add_connection('/a', TEXT, typestore=store)
        for i in range(count):
            writer.write(topic, i + 1, store.serialize_cdr(text(f'text {i}'), TEXT))
    return path / f'{path.name}.db3'


@pytest.mark.parametrize('mode', [CompressionMode.NONE, CompressionMode.MESSAGE])
def test_of_a_sqlite_file_cut_off_is_saved_what_lies_before_the_cut(tmp_path, mode):
    file = sqlite_bag(tmp_path / 'bag', mode)
    every = contents(file)
    data = file.read_bytes()
    file.write_bytes(data[: 2 * len(data) // 3])
    recovery = recovered(file, tmp_path / 'saved')
    found = contents(tmp_path / 'saved')
    readable = set(found)
    assert found == [message for message in every if message in readable]
    assert len(every) // 3 < len(found) < len(every)
    last = f'rows {found[-1][1] + 1} to the end cannot be read'
    assert f'bag.db3, table messages: {last}' in str(recovery.problems[-1])


def test_a_sqlite_file_with_pages_overwritten_loses_what_stood_on_them(tmp_path):
    file = sqlite_bag(tmp_path / 'bag')
    every = contents(file)
    data = bytearray(file.read_bytes())
    first, second = data.find(b'text 700\0'), data.find(b'text 1500\0')
    for at in (first, second):
        page = at - at % 4096
        data[page : page + 4096] = bytes([255]) * 4096
    file.write_bytes(data)
    recovery = recovered(tmp_path / 'bag', tmp_path / 'saved')
    found = contents(tmp_path / 'saved')
    lost = set(every) - set(found)
    assert set(found) < set(every)
    assert {701, 1501} <= {message[1] for message in lost}
    assert len(lost) < 400
    assert [str(problem).count('table messages: rows') for problem in recovery.problems] == [1, 1]


def test_a_sqlite_file_without_its_first_page_is_told(tmp_path):
    file = sqlite_bag(tmp_path / 'bag')
    file.write_bytes(b'\xff' * 4096 + file.read_bytes()[4096:])
    recovery = recovered(tmp_path / 'bag', tmp_path / 'saved')
    assert recovery.messages == 0
    assert 'cannot be read as a bag in sqlite3' in str(recovery.problems[0])


def test_what_is_not_of_ros_keeps_its_encoding_its_schema_and_what_lies_beside(tmp_path):
    foreign = bytes(range(256))
    with (tmp_path / 'a.mcap').open('wb') as stream:
        writer = McapLibraryWriter(stream, chunk_size=100)
        writer.start('', 'test')
        schemas = [
            writer.register_schema('pose', 'protobuf', foreign),
            writer.register_schema('thing', 'jsonschema', b'{}'),
            0,
        ]
        kinds = zip(('protobuf', 'json', 'text'), schemas, strict=True)
        channels = [writer.register_channel(f'/{k}', k, s, {'who': k}) for k, s in kinds]
        writer.add_attachment(3, 4, 'calib.txt', 'text/plain', b'k: 1')
        for i in range(9):
            writer.add_message(channels[i % 3], i, b'data %d' % i, i + 1, i + 2)
        writer.add_metadata('site', {'tree': 'oak'})
        writer.finish()
    recovery = recovered(tmp_path / 'a.mcap', tmp_path / 'saved')
    assert not recovery.problems
    assert recovery.missing == 0
    with (tmp_path / 'saved' / 'saved_0.mcap').open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True)
        found = [
            (c.topic, c.message_encoding, s and (s.name, s.encoding, s.data), c.metadata, m.data)
            for s, c, m in reader.iter_messages()
        ]
        (attachment,) = reader.iter_attachments()
        notes = {record.name: record.metadata for record in reader.iter_metadata()}
        statistics = reader.get_summary().statistics
    about = [('pose', 'protobuf', foreign), ('thing', 'jsonschema', b'{}'), None]
    names = ('protobuf', 'json', 'text')
    assert found == [
        (f'/{names[i % 3]}', names[i % 3], about[i % 3], {'who': names[i % 3]}, b'data %d' % i)
        for i in range(9)
    ]
    assert (attachment.name, attachment.media_type, attachment.data) == (
        *('calib.txt', 'text/plain'),
        b'k: 1',
    )
    assert (attachment.log_time, attachment.create_time) == (4, 3)
    assert notes.pop('rosbag2')
    assert notes == {'site': {'tree': 'oak'}}
    assert (statistics.attachment_count, statistics.metadata_count) == (1, 2)


def test_what_could_not_be_saved_is_counted(tmp_path):
    file = small(tmp_path / 'bag')
    data = bytearray(file.read_bytes())
    data[data.find(b'texE')] ^= 1
    file.write_bytes(data)
    recovery = recovered(tmp_path / 'bag', tmp_path / 'saved')
    assert recovery.missing == 12 - recovery.messages > 0


def test_progress_is_told_after_each_thousand_messages(tmp_path):
    """Two files alike of a thousand each: the second is where the first was, and a half more."""
    with BagWriter(tmp_path / 'bag', chunk_size=9000) as bag:
        topic = bag.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
        for stamp in range(2000):
            if stamp == 1000:
                bag.split()
            bag.write(topic, stamp, b'\0\1\0\0\1')
    shares = []
    with BagWriter(tmp_path / 'saved') as writer:
        Recovery(writer).save(tmp_path / 'bag', shares.append)
    first, second = shares
    assert 0.0 < first <= 0.5
    assert second - first == pytest.approx(0.5, abs=0.02)
