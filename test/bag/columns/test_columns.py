"""Columns: shapes, selections, order, foreign bags, and messages that are not of their type."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest
from mcap.writer import Writer as McapWriter
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.rosbag2.enums import CompressionFormat, CompressionMode
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.checks.stamps import stamps
from agv_motion.bag.columns import topic_decoder
from agv_motion.bag.columns.column import Ragged, Texts
from agv_motion.bag.columns.columns import _expected, columns_of, read_topic, read_topics
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import batches as mcap_batches
from agv_motion.bag.mcap import chunk_batches
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError, SourceError

STORE = get_typestore(Stores.ROS2_JAZZY)
TWIST = 'geometry_msgs/msg/TwistStamped'
JOINTS = 'sensor_msgs/msg/JointState'
TEXT = 'std_msgs/msg/String'
SECOND = 1_000_000_000


def definition(kind):
    return STORE.generate_msgdef(kind, ros_version=2)[0]


def write(path, messages, *, kind, text=None, stamps=None):
    """Write messages in CDR on one topic, at ``stamps`` [ns], in small chunks."""
    with BagWriter(path, chunk_size=3000, chunk_duration=1e9) as writer:
        topic = writer.add_topic('/topic', kind, text or definition(kind), type_hash='')
        for i, data in enumerate(messages):
            writer.write(topic, i if stamps is None else stamps[i], bytes(data))
    return path


def columns(path, fields=None, *span):
    with BagReader(path) as bag:
        return read_topic(bag, '/topic', fields, *span)


def test_sequences_inside_arrays_of_one_and_of_two(tmp_path):
    """By hand: a count, its bytes, and up to the next multiple of four nothing."""
    beside = f'{"=" * 80}\nMSG: b/B\nuint8[] values'
    found = columns(
        write(
            tmp_path / 'bag',
            [
                bytes.fromhex('00010000 01000000 01000000 02000000 02030000 00000000'),
                bytes.fromhex('00010000 02000000 04050000 00000000 01000000 06'),
            ],
            kind='a/msg/A',
            text=f'b/B[1] one\nb/B[2] two\n{beside}',
        )
    ).fields
    told = {name: [[list(x) for x in row] for row in column] for name, column in found.items()}
    assert told == {'one.values': [[[1]], [[4, 5]]], 'two.values': [[[2, 3], []], [[], [6]]]}
    assert found['one.values'].offsets.tolist() == [0, 1, 2]
    assert found['two.values'].offsets.tolist() == [0, 2, 4]


def joints(names, count, i):
    make = STORE.types
    header = make['std_msgs/msg/Header'](make['builtin_interfaces/msg/Time'](i, 5), 'base_link')
    position = np.arange(count) + i / 7
    message = make[JOINTS](header, names, position, -position, np.zeros(0))
    return STORE.serialize_cdr(message, JOINTS)


def test_arrays_of_constant_length_are_rectangular_and_empty_ones_too(tmp_path):
    write(tmp_path / 'bag', [joints(['a', 'bc'], 2, i) for i in range(500)], kind=JOINTS)
    found = columns(tmp_path / 'bag')
    position = found.fields['position']
    assert isinstance(position, np.ndarray)
    assert position.shape == (500, 2)
    assert position[3].tolist() == [3 / 7, 1 + 3 / 7]
    assert found.fields['effort'].shape == (500, 0)
    names = found.fields['name']
    assert isinstance(names, Texts)
    assert (names.shape, names[7].tolist()) == ((500, 2), ['a', 'bc'])
    assert (names == 'bc').sum() == 500
    assert found.nanoseconds('header.stamp')[2] == 2 * SECOND + 5
    assert found.seconds('header.stamp')[2] == pytest.approx(2.000000005, abs=1e-15)
    assert found.seconds('header.stamp', found.nanoseconds('header.stamp')[0])[2] == 2.0


def test_arrays_of_changing_length_are_ragged_rows(tmp_path):
    counts = [2, 2, 3, 0, 1, 2, 700] * 30
    raw = [joints(['a'] * n, n, i) for i, n in enumerate(counts)]
    write(tmp_path / 'bag', raw, kind=JOINTS)
    position = columns(tmp_path / 'bag').fields['position']
    assert isinstance(position, Ragged)
    assert position.lengths.tolist() == counts
    assert position[2].tolist() == [2 / 7, 1 + 2 / 7, 2 + 2 / 7]
    assert position[-1].shape == (700,)
    assert position[2:4].tolist() == [position[2].tolist(), []]


def test_messages_that_are_all_different_take_the_general_way(tmp_path, monkeypatch):
    raw = [joints([str(i)] * (i % 5), i % 7, i) for i in range(300)]
    path = write(tmp_path / 'bag', raw, kind=JOINTS)
    usual = columns(path)
    monkeypatch.setattr(topic_decoder, 'FEW', 10**9)
    general = columns(path)
    for field, column in usual.fields.items():
        assert column.tolist() == general.fields[field].tolist()


def test_rows_are_in_the_order_of_their_stamps(tmp_path):
    stamps = [(i * 37) % 200 for i in range(200)]
    raw = [joints(['a'] * (s % 3), s % 3, s) for s in stamps]
    write(tmp_path / 'bag', raw, kind=JOINTS, stamps=stamps)
    found = columns(tmp_path / 'bag')
    assert found.stamps.tolist() == list(range(200))
    assert found.fields['header.stamp.sec'].tolist() == list(range(200))
    assert found.fields['position'].lengths.tolist() == [s % 3 for s in range(200)]
    assert found.fields['position'][5].tolist() == [5 / 7, 1 + 5 / 7]


def test_a_time_range_is_selected(tmp_path):
    write(tmp_path / 'bag', [joints(['a'], 1, i) for i in range(300)], kind=JOINTS)
    found = columns(tmp_path / 'bag', ['position'], 20, 250)
    assert found.stamps.tolist() == list(range(20, 250))
    assert found.fields['position'][0, 0] == 20 / 7
    assert len(columns(tmp_path / 'bag', ['position'], 1000).stamps) == 0
    assert columns(tmp_path / 'bag', ['position', 'name'], 0, 0).fields['position'].shape == (0, 0)


def test_texts_that_are_all_different_and_not_ascii(tmp_path):
    texts = [f'Ü{i}' for i in range(3000)] + ['', 'a\0', '\0']
    raw = [STORE.serialize_cdr(STORE.types[TEXT](t), TEXT) for t in texts]
    write(tmp_path / 'bag', raw, kind=TEXT)
    assert columns(tmp_path / 'bag').fields['data'].tolist() == texts


@pytest.mark.parametrize('plugin', list(StoragePlugin))
@pytest.mark.parametrize('mode', list(CompressionMode))
def test_columns_of_foreign_bags(tmp_path, plugin, mode):
    if plugin is StoragePlugin.SQLITE3 and mode is CompressionMode.STORAGE:
        pytest.skip('sqlite3 has no compression of its own')
    writer = RosbagsWriter(tmp_path / 'bag', version=9, storage_plugin=plugin)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection('/topic', JOINTS, typestore=STORE)
        other = writer.add_connection('/other', TEXT, typestore=STORE)
        for i in range(3000):
            writer.write(connection, i, joints(['a', 'bc'], 2, i))
            writer.write(other, i, STORE.serialize_cdr(STORE.types[TEXT](f'{i}'), TEXT))
    with BagReader(tmp_path / 'bag') as bag:
        found = read_topics(bag)
    assert found['/topic'].fields['position'][:, 0].tolist() == [i / 7 for i in range(3000)]
    assert found['/other'].fields['data'].tolist() == [str(i) for i in range(3000)]


@pytest.mark.skipif(not Path('/proc/self/status').exists(), reason='Linux tells it there')
def test_pages_of_the_file_do_not_stay_in_memory(tmp_path):
    with BagWriter(tmp_path / 'bag', compression='none', chunk_duration=1e9) as writer:
        topic = writer.add_topic('/topic', JOINTS, definition(JOINTS), type_hash='')
        for i in range(200):
            writer.write(topic, i, bytes(joints(['a'], 10_000, i)))

    def mapped():
        row = Path('/proc/self/status').read_text().partition('RssFile:')[2]
        return int(row.split()[0]) * 1024

    before = mapped()
    with BagReader(tmp_path / 'bag') as bag:
        found = read_topic(bag, '/topic', ['header.stamp'])
        assert mapped() - before < 4e6 < sum(file.path.stat().st_size for file in bag.files)
    assert found.fields['header.stamp.sec'].tolist() == list(range(200))


@pytest.fixture
def many_small_groups(monkeypatch):
    """Have four threads, and every chunk decoded by itself."""
    monkeypatch.setattr(mcap_batches, 'threads', lambda: 4)
    monkeypatch.setattr(chunk_batches, 'GROUP', 1 << 12)


@pytest.mark.usefixtures('many_small_groups')
def test_threads_keep_the_order_of_each_topic_also_where_it_has_two_channels(tmp_path):
    path = tmp_path / 'bag.mcap'
    with path.open('wb') as stream:
        writer = McapWriter(stream, chunk_size=3000)
        writer.start(profile='ros2')
        schema = writer.register_schema(TEXT, 'ros2msg', definition(TEXT).encode())
        names = ['/a', '/b', '/a']
        channels = [writer.register_channel(name, 'cdr', schema) for name in names]
        for i in range(9000):
            data = bytes(STORE.serialize_cdr(STORE.types[TEXT](f'{i}'), TEXT))
            writer.add_message(channels[i % 3], log_time=i, publish_time=i, data=data)
        writer.finish()
    with BagReader(path) as bag:
        assert sum(file.indexed and len(file.chunks) for file in bag.files) > 50
        found = read_topics(bag)
    every = range(9000)
    assert found['/b'].fields['data'].tolist() == [str(i) for i in every if i % 3 == 1]
    assert found['/a'].fields['data'].tolist() == [str(i) for i in every if i % 3 != 1]
    assert found['/a'].stamps.tolist() == [i for i in every if i % 3 != 1]


@pytest.mark.usefixtures('many_small_groups')
@pytest.mark.parametrize('damaged', [0, 1, 5, -1])
def test_a_damaged_chunk_ends_all_threads_with_its_place(tmp_path, damaged):
    write(tmp_path / 'bag', [joints(['a'], i % 3, i) for i in range(900)], kind=JOINTS)
    path = tmp_path / 'bag' / 'bag_0.mcap'
    with BagReader(path) as bag:
        chunk = bag.files[0].chunks[damaged]
    content = bytearray(path.read_bytes())
    content[chunk.offset + chunk.length - 9] ^= 0xFF
    path.write_bytes(content)
    with pytest.raises(DamagedBagError, match=f'bag_0.mcap, byte {chunk.offset}:'):
        columns(path)


def test_what_is_the_same_in_all_messages_is_in_memory_once(tmp_path):
    raw = [joints(['a', 'b'], 2, 7)] * 500
    found = columns(write(tmp_path / 'same', raw, kind=JOINTS)).fields
    assert {name: column.shape for name, column in found.items()} == {
        'header.stamp.sec': (500,), 'header.stamp.nanosec': (500,), 'header.frame_id': (500,),
        'name': (500, 2), 'position': (500, 2), 'velocity': (500, 2), 'effort': (500, 0),
    }  # fmt: skip
    assert found['position'].base is not None
    assert (found['position'].strides[0], found['position'].flags.writeable) == (0, False)
    changed = columns(write(tmp_path / 'last', [*raw, joints(['a', 'b'], 2, 8)], kind=JOINTS))
    position = changed.fields['position']
    assert position.flags.writeable
    assert position[[0, 499, 500]].tolist() == [[1.0, 2.0], [1.0, 2.0], [8 / 7, 1 + 8 / 7]]


def test_a_zero_that_changes_its_sign_and_nan_are_kept_bit_by_bit(tmp_path):
    kind = 'std_msgs/msg/Float64'
    values = [0.0] * 9 + [-0.0, float('nan')]
    raw = [STORE.serialize_cdr(STORE.types[kind](v), kind) for v in values]
    found = columns(write(tmp_path / 'bag', raw, kind=kind)).fields['data']
    assert found.tobytes() == np.array(values).tobytes()


def test_a_field_that_is_not_there_is_refused_with_a_near_name(tmp_path):
    write(tmp_path / 'bag', [joints(['a'], 1, 1)], kind=JOINTS)
    with pytest.raises(ConfigurationError, match="no field 'positon'; did you mean 'position'"):
        columns(tmp_path / 'bag', ['positon'])


@pytest.mark.parametrize(
    ('data', 'complaint'),
    [
        (b'\0\1\0\0', 'end before a'),
        (b'\0\1\0\0\0', 'end before a'),
        (b'\0\1\0\0' + bytes(200), 'its type ends after'),
        (b'\0\7\0\0' + bytes(60), r'encapsulation 0x0007'),
        (b'\0\1\0\0' + bytes(8) + b'\xff' * 4 + bytes(60), 'end before a'),
        (b'\0\1\0\0' + bytes(8) + b'\3\0\0\0\xff\xff\0' + bytes(49), 'frame_id is not UTF-8'),
    ],
)
@pytest.mark.parametrize('times', [1, 20])
def test_a_message_that_is_not_of_its_type_is_an_error_with_its_place(
    tmp_path, data, complaint, times
):
    write(tmp_path / 'bag', [data] * times, kind=TWIST)
    with pytest.raises(DamagedBagError, match=f'bag_0.mcap, byte [0-9]+:.*{complaint}'):
        columns(tmp_path / 'bag')


def test_an_empty_message_has_the_one_byte_that_ros_gives_it(tmp_path):
    kind = 'made/msg/Event'
    write(tmp_path / 'bag', [b'\0\1\0\0\0'] * 9, kind=kind, text='# nothing\n')
    found = columns(tmp_path / 'bag').fields
    assert [len(column) for column in found.values()] == [9]


@pytest.mark.parametrize('field', ['position', 'header.frame_id', 'header.stamp'])
def test_a_field_that_is_no_time_or_was_not_read_is_refused_as_a_time(tmp_path, field):
    write(tmp_path / 'bag', [joints(['a'], 1, 1)], kind=JOINTS)
    found = columns(tmp_path / 'bag', ['position', 'header.frame_id', 'header.stamp.sec'])
    with pytest.raises(ConfigurationError, match=f'{field} was not read, or is no time'):
        found.nanoseconds(field)


def two_topics(path):
    """Write /a from 1000 s on, and /b from 1000.8 s on, every 0.1 s."""
    with BagWriter(path) as writer:
        a, b = (writer.add_topic(t, TEXT, definition(TEXT), type_hash='') for t in ('/a', '/b'))
        for i in range(20):
            message = STORE.serialize_cdr(STORE.types[TEXT]('xyz'[i % 3]), TEXT)
            writer.write(a, 1000 * SECOND + i * SECOND // 10, bytes(message))
            writer.write(b, 1000 * SECOND + (i + 8) * SECOND // 10, bytes(message))
    return path


def test_seconds_of_all_topics_count_from_the_start_of_the_bag(tmp_path):
    with BagReader(two_topics(tmp_path / 'bag')) as bag:
        found = read_topics(bag)
        later = read_topic(bag, '/b', start=bag.start + SECOND)
    assert found['/a'].seconds()[:2] == pytest.approx([0.0, 0.1], abs=1e-12)
    assert found['/b'].seconds()[:2] == pytest.approx([0.8, 0.9], abs=1e-12)
    assert later.seconds()[0] == pytest.approx(1.0, abs=1e-12)
    assert later.seconds(since=later.stamps[0])[:2] == pytest.approx([0.0, 0.1], abs=1e-12)
    with pytest.raises(ConfigurationError, match=r'since = 1000\.0: give whole nanoseconds'):
        later.seconds(since=1000.0)


def test_what_is_the_same_in_all_messages_is_there_once_though_they_are_put_in_order(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', 'a/msg/A', 'int8 x\nint8 y', type_hash='')
        for stamp in (3, 1, 2):
            writer.write(topic, stamp, b'\0\1\0\0\7' + bytes((stamp,)))
    with BagReader(tmp_path / 'bag') as bag:
        found = read_topic(bag, '/a')
    assert (found.fields['x'].tolist(), found.fields['y'].tolist()) == ([7, 7, 7], [1, 2, 3])
    assert found.fields['x'].strides[0] == 0


def test_without_messages_there_are_no_seconds_and_no_start(tmp_path):
    with BagReader(two_topics(tmp_path / 'bag')) as bag:
        none = columns_of(bag.topics['/a'], None, [])
        assert (none.start, none.seconds().shape) == (0, (0,))
        size = bag.files[0].unpacked_size
        assert _expected(bag, frozenset(('/a',)), 0, 2**64) == {'/a': (20, size)}
        assert _expected(bag, frozenset(('/a', '/b')), 0, bag.start) == {
            '/a': (0, size), '/b': (0, size),
        }  # fmt: skip


@pytest.mark.parametrize('time', [1000.5, np.float64(1e12), '1000', True, float('nan')])
def test_times_that_are_no_nanoseconds_are_refused(tmp_path, time):
    with BagReader(two_topics(tmp_path / 'bag')) as bag:
        for span in ({'start': time}, {'stop': time}):
            (name,) = span
            with pytest.raises(ConfigurationError, match=f'{name} = .*give whole nanoseconds'):
                read_topic(bag, '/a', **span)
            with pytest.raises(ConfigurationError, match=f'{name} = .*give whole nanoseconds'):
                bag.messages(['/a'], **span)
        assert len(read_topic(bag, '/a', start=np.int64(1001 * SECOND)).stamps) == 10


def test_one_name_is_a_list_of_one(tmp_path):
    with BagReader(two_topics(tmp_path / 'bag')) as bag:
        assert list(read_topic(bag, '/a', 'data').fields) == ['data']
        assert list(read_topics(bag, {'/a': 'data'})['/a'].fields) == ['data']
        assert list(read_topics(bag, '/a')) == ['/a']
        assert list(stamps(bag, '/b')) == ['/b']
        assert {m.connection.topic for m in bag.messages('/b')} == {'/b'}


@pytest.mark.parametrize('kind', ['mcap', 'sqlite'])
def test_a_closed_bag_says_that_it_was_closed(tmp_path, kind):
    path = tmp_path / 'bag'
    if kind == 'mcap':
        two_topics(path)
    else:
        store = get_typestore(Stores.ROS2_JAZZY)
        with RosbagsWriter(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
            connection = writer.add_connection('/a', TEXT, typestore=store)
            for i in range(3):
                writer.write(connection, i, store.serialize_cdr(store.types[TEXT]('x'), TEXT))
    with BagReader(path) as bag:
        begun = bag.messages(['/a'])
        next(begun)
        unbegun = bag.messages(['/a'])
    for reading in (
        lambda: read_topic(bag, '/a'),
        lambda: stamps(bag),
        lambda: list(bag.messages()),
        lambda: list(unbegun),
    ):
        with pytest.raises(SourceError, match='was closed: read inside') as caught:
            reading()
        assert 'recover' not in str(caught.value)


def test_columns_and_their_parts_are_told_in_one_line(tmp_path):
    raw = [joints(['a', 'b'], i % 3, i) for i in range(50)]
    with BagReader(write(tmp_path / 'bag', raw, kind=JOINTS)) as bag:
        found = read_topic(bag, '/topic', ['position', 'name', 'header.stamp'])
        assert repr(found) == '/topic (sensor_msgs/msg/JointState): 50 x 4 fields'
        assert repr(bag) == f"BagReader('{tmp_path / 'bag'}': 1 topics in 1 files)"
    assert repr(found.fields['position']) == 'Ragged(50 rows of 0 to 2 values)'
    assert repr(found.fields['name']) == "Texts('a', 'b', 'a', ...; shape (50, 2))"


def test_texts_are_compared_element_by_element(tmp_path):
    with BagReader(two_topics(tmp_path / 'bag')) as bag:
        found = read_topics(bag)
    texts = found['/a'].fields['data']
    assert (texts == 'x')[:4].tolist() == [True, False, False, True]
    assert (texts != 'x')[:4].tolist() == [False, True, True, False]
    assert (texts != 'unknown').all()
    assert (texts == found['/b'].fields['data']).all()
    assert not (texts[1:] != texts[1:]).any()


def odd_columns(path):
    """Return columns of arrays of every shape, and the messages they come from."""
    raw = [joints(['a', 'b'], i % 3, i) for i in range(7)]
    with BagReader(write(path, raw, kind=JOINTS, stamps=[SECOND * i for i in range(7)])) as bag:
        return read_topic(bag, '/topic')


def test_log_times_beyond_all_tables_stay_numbers(tmp_path):
    path = write(tmp_path / 'bag', [joints(['a'], 1, 0)], kind=JOINTS, stamps=[2**63 + 5])
    found = columns(path)
    assert found.seconds().tolist() == [0.0]
    if importlib.util.find_spec('pyarrow'):
        assert found.to_arrow()['log_time'].to_pylist() == [2**63 + 5]
    if importlib.util.find_spec('pandas'):
        assert found.to_pandas().index.tolist() == [2**63 + 5]


def test_columns_become_an_arrow_table(tmp_path):
    pytest.importorskip('pyarrow')
    found = odd_columns(tmp_path / 'bag')
    table = found.to_arrow()
    assert table.column_names == ['log_time', *found.fields]
    assert table['log_time'].cast('int64').to_pylist() == found.stamps.tolist()
    for path, column in found.fields.items():
        assert table[path].to_pylist() == column.tolist()


def test_columns_become_a_data_frame(tmp_path):
    pytest.importorskip('pandas')
    found = odd_columns(tmp_path / 'bag')
    frame = found.to_pandas()
    assert list(frame.columns) == list(found.fields)
    assert frame.index.as_unit('ns').asi8.tolist() == found.stamps.tolist()
    assert str(frame.index.tz) == 'UTC'
    for path, column in found.fields.items():
        cells = [c.tolist() if isinstance(c, np.ndarray) else c for c in frame[path]]
        assert cells == column.tolist()


@pytest.mark.parametrize(('module', 'method'), [('pandas', 'to_pandas'), ('pyarrow', 'to_arrow')])
def test_a_table_library_that_is_missing_is_told(tmp_path, monkeypatch, module, method):
    found = odd_columns(tmp_path / 'bag')
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ConfigurationError, match=rf'{method}\(\) needs {module}: pip install'):
        getattr(found, method)()
