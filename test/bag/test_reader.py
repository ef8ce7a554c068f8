"""The reader against rosbags, mcap and our own writer, over bags of every kind."""

from __future__ import annotations

from struct import pack_into

import pytest
from mcap.writer import CompressionType, IndexType, Writer
from rosbags.rosbag2 import Reader, StoragePlugin
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.rosbag2.enums import CompressionFormat, CompressionMode
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter, OfferedQos
from agv_motion.errors import ConfigurationError, SourceError

STORE = get_typestore(Stores.ROS2_JAZZY)
TEXT = 'std_msgs/msg/String'
SECOND = 1_000_000_000


def text(i):
    return bytes(STORE.serialize_cdr(STORE.types[TEXT](f'line {i}'), TEXT))


def definition():
    return STORE.generate_msgdef(TEXT, ros_version=2)[0]


def ours(path, stamps, **options):
    """Write messages on two topics in turn, at ``stamps`` [s]; return what was written."""
    written = []
    with BagWriter(path, chunk_size=400, chunk_duration=1e9, **options) as writer:
        qos = [OfferedQos(depth=1, durability='transient_local')]
        topics = {
            '/a': writer.add_topic('/a', TEXT, definition(), type_hash='RIHS01_a'),
            '/b': writer.add_topic('/b', TEXT, definition(), type_hash='', qos=qos),
        }
        for i, stamp in enumerate(stamps):
            topic = '/b' if i % 2 else '/a'
            writer.write(topics[topic], stamp * SECOND, text(i), stamp * SECOND + 1, i)
            written.append((topic, stamp * SECOND, text(i)))
    return written


def read(path, *arguments, **options):
    with BagReader(path) as bag:
        return [(m.connection.topic, m.stamp, m.data) for m in bag.messages(*arguments, **options)]


@pytest.mark.parametrize('compression', ['zstd', 'lz4', 'none'])
def test_every_message_comes_back(tmp_path, compression):
    written = ours(tmp_path / 'bag', range(1, 101), compression=compression)
    assert read(tmp_path / 'bag') == written
    assert read(tmp_path / 'bag' / 'bag_0.mcap') == written


def test_what_a_bag_says_of_its_topics(tmp_path):
    ours(tmp_path / 'bag', range(1, 101))
    with BagReader(tmp_path / 'bag') as bag:
        assert (bag.start, bag.end, bag.message_count) == (SECOND, 100 * SECOND, 100)
        assert bag.counts == {'/a': 50, '/b': 50}
        a, b = bag.topics['/a'], bag.topics['/b']
        assert (a.type, a.definition, a.definition_encoding) == (TEXT, definition(), 'ros2msg')
        assert (a.hash, a.qos, a.latched) == ('RIHS01_a', (OfferedQos(),), False)
        assert b.qos == (OfferedQos(depth=1, durability='transient_local'),)
        assert b.latched
        message = next(bag.messages())
        assert (message.publish, message.sequence) == (SECOND + 1, 0)
        assert bag.problems == []


def test_messages_come_in_the_order_of_time_though_a_long_file_spans_two_short_ones(tmp_path):
    parts = {'a': [1, 100], 'b': [10, 20], 'c': [50, 60]}
    (tmp_path / 'bag').mkdir()
    for name, stamps in parts.items():
        ours(tmp_path / name, stamps)
        (tmp_path / name / f'{name}_0.mcap').rename(tmp_path / 'bag' / f'{name}.mcap')
    found = [stamp // SECOND for _, stamp, _ in read(tmp_path / 'bag')]
    assert found == [1, 10, 20, 50, 60, 100]


def test_messages_come_in_the_order_of_time_though_chunks_overlap(tmp_path):
    stamps = [5, 4, 3, 2, 1, 9, 8, 1, 7, 6] * 30 + list(range(300))
    written = ours(tmp_path / 'bag', stamps)
    assert read(tmp_path / 'bag') == sorted(written, key=lambda row: row[1])


def test_the_messages_before_a_damaged_chunk_are_read_and_then_it_is_named(tmp_path):
    written = ours(tmp_path / 'bag', range(100))
    file = tmp_path / 'bag' / 'bag_0.mcap'
    with BagReader(file) as bag:
        chunks = bag.files[0].chunks
        assert len(chunks) > 10
        damaged = chunks[len(chunks) // 2]
    data = bytearray(file.read_bytes())
    data[damaged.offset + damaged.length - 1] ^= 0xFF
    file.write_bytes(data)
    found = []
    with BagReader(file) as bag, pytest.raises(DamagedBagError, match=f'byte {damaged.offset}'):
        found.extend((m.connection.topic, m.stamp, m.data) for m in bag.messages())
    before = [row for row in written if row[1] < damaged.start]
    assert found == before
    assert len(before) > 10


@pytest.mark.parametrize(
    ('field', 'value', 'finding'),
    [('<H', 99, 'channel 99, which is not described'), ('<Q', 600, 'no whole message')],
)
def test_a_message_of_no_channel_or_beyond_its_chunk_is_named_also_among_small_chunks(
    tmp_path, field, value, finding
):
    written = ours(tmp_path / 'bag', range(100), compression='none')
    file = tmp_path / 'bag' / 'bag_0.mcap'
    data = bytearray(file.read_bytes())
    at = data.index(text(50)) - records.MESSAGE_HEAD.size
    pack_into(field, data, at + (9 if field == '<H' else 1), value)
    file.write_bytes(data)
    found = []
    with BagReader(file, validate=False) as bag, pytest.raises(DamagedBagError, match=finding):
        found.extend((m.connection.topic, m.stamp, m.data) for m in bag.messages())
    assert found == written[: len(found)]
    assert 40 < len(found) <= 50


def test_topics_and_times_are_selected(tmp_path):
    written = ours(tmp_path / 'bag', range(100))
    found = read(tmp_path / 'bag', ['/b'], start=20 * SECOND, stop=41 * SECOND)
    assert found == [r for r in written if r[0] == '/b' and 20 <= r[1] // SECOND < 41]


def test_a_topic_that_is_not_there_is_refused_with_a_near_name(tmp_path):
    ours(tmp_path / 'bag', range(3))
    with (
        BagReader(tmp_path / 'bag') as bag,
        pytest.raises(ConfigurationError, match=r"no topic '/bb'; did you mean '/b'"),
    ):
        bag.messages(['/bb'])


@pytest.mark.parametrize('chunked', [True, False])
@pytest.mark.parametrize('index', [IndexType.ALL, IndexType.NONE, IndexType.CHUNK])
@pytest.mark.parametrize('repeated', [True, False])
def test_files_of_mcap_with_and_without_chunks_indexes_and_summary(
    tmp_path, chunked, index, repeated
):
    path = tmp_path / 'file.mcap'
    compression = CompressionType.LZ4
    writer = Writer(
        str(path), 500, compression, index, repeated, chunked, use_statistics=repeated,
        use_summary_offsets=repeated, enable_crcs=True,
    )  # fmt: skip
    writer.start('ros2')
    schema = writer.register_schema(TEXT, 'ros2msg', definition().encode())
    channels = [writer.register_channel(topic, 'cdr', schema) for topic in ('/a', '/b')]
    for i in range(100):
        writer.add_message(channels[i % 2], 7 * i, text(i), 7 * i)
    writer.finish()
    expected = [('/b' if i % 2 else '/a', 7 * i, text(i)) for i in range(100)]
    assert read(path) == expected
    assert read(path, ['/b'], 70, 140) == [r for r in expected if r[0] == '/b' and 70 <= r[1] < 140]
    with BagReader(path) as bag:
        assert bag.counts == {'/a': 50, '/b': 50}
        assert (bag.start, bag.end) == (0, 693)


@pytest.mark.parametrize('plugin', list(StoragePlugin))
@pytest.mark.parametrize('mode', list(CompressionMode))
def test_bags_of_rosbags_in_mcap_and_sqlite_with_every_compression(tmp_path, plugin, mode):
    if plugin is StoragePlugin.SQLITE3 and mode is CompressionMode.STORAGE:
        pytest.skip('sqlite3 has no compression of its own')
    path = tmp_path / 'bag'
    writer = RosbagsWriter(path, version=9, storage_plugin=plugin)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection('/a', TEXT, typestore=STORE)
        writer.add_connection('/silent', TEXT, typestore=STORE)
        for i in range(100):
            writer.write(connection, i * SECOND, text(i))
    assert read(path) == [('/a', i * SECOND, text(i)) for i in range(100)]
    assert read(path, ['/a'], SECOND, 3 * SECOND) == [('/a', i * SECOND, text(i)) for i in (1, 2)]
    with BagReader(path) as bag, Reader(path) as theirs:
        assert bag.counts == {'/a': 100, '/silent': 0}
        assert (bag.start, bag.end + 1) == (theirs.start_time, theirs.end_time)
        assert bag.topics['/a'].definition.strip() == 'string data'
        assert bag.problems == []


def test_a_bag_without_messages_begins_and_ends_at_0(tmp_path):
    ours(tmp_path / 'bag', [])
    with BagReader(tmp_path / 'bag') as bag:
        assert (bag.start, bag.end) == (0, 0)


def test_the_files_of_a_split_bag_follow_each_other_and_metadata_may_be_missing(tmp_path):
    written = []
    for number in (0, 1, 10, 2):
        stamps = range(100 * number, 100 * number + 50)
        written += ours(tmp_path / f'part_{number}', stamps)
        (tmp_path / 'bag').mkdir(exist_ok=True)
        part = tmp_path / f'part_{number}' / f'part_{number}_0.mcap'
        part.rename(tmp_path / 'bag' / f'bag_{number}.mcap')
    assert read(tmp_path / 'bag') == sorted(written, key=lambda row: row[1])
    with BagReader(tmp_path / 'bag') as bag:
        assert 'no metadata' in str(bag.problems[0])
        assert (bag.start, bag.end) == (min(row[1] for row in written), max(r[1] for r in written))
        assert [file.path.name for file in bag.files] == [
            'bag_0.mcap', 'bag_1.mcap', 'bag_2.mcap', 'bag_10.mcap',
        ]  # fmt: skip


@pytest.mark.parametrize(
    ('content', 'complaint'),
    [(None, 'does not exist'), (b'', 'is empty'), (b'SQLite format 3', 'is no MCAP file')],
)
def test_what_is_no_bag_is_refused_with_its_name(tmp_path, content, complaint):
    path = tmp_path / 'file.mcap'
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(SourceError, match=f'file.mcap.*{complaint}'):
        BagReader(path)


def test_a_folder_without_a_bag_is_refused(tmp_path):
    with pytest.raises(SourceError, match=r'is no bag: it has no \.mcap'):
        BagReader(tmp_path)


@pytest.mark.parametrize(
    ('harmless', 'lossy'), [([], False), ([True], False), ([True, False], True)]
)
def test_only_what_does_harm_makes_a_bag_lossy(tmp_path, harmless, lossy):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
        writer.write(topic, 1, b'\0\1\0\0\1')
    with BagReader(tmp_path / 'bag') as bag:
        bag.problems += [DamagedBagError('x', 0, 'odd', harmless=each) for each in harmless]
        assert bag.lossy is lossy
