"""Bags out of bags: nothing is lost, added or changed but what was asked for."""

from __future__ import annotations

import importlib.util
from contextlib import ExitStack
from functools import partial
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.writer import Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as RosbagsWriter
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag import BagReader, BagWriter, DamagedBagError
from agv_motion.bag.editing import edit as engine
from agv_motion.bag.editing.edit import Edit, edit
from agv_motion.bag.editing.steps import Step
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.selection import Selection
from agv_motion.errors import SourceError

_SPEC = importlib.util.spec_from_file_location('bags', Path(__file__).with_name('bags.py'))
bags = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(bags)
SECOND, EXTRAS, TEXT = bags.SECOND, bags.EXTRAS, bags.TEXT
write, told, judged, text = bags.write, bags.told, bags.judged, bags.text


def edited(folder, sources, **what):
    with ExitStack() as stack:
        opened = [stack.enter_context(BagReader(source)) for source in sources]
        return edit(opened, folder, Edit(**what))


@pytest.fixture(scope='module')
def walk(tmp_path_factory):
    return write(tmp_path_factory.mktemp('sources') / 'walk')


def test_a_copy_has_the_same_chunks_and_all_else(walk, tmp_path):
    report = edited(tmp_path / 'copy', [walk])
    assert (report.messages, report.made, report.files) == (41, 0, 1)
    assert report.copied > 3
    assert judged(tmp_path / 'copy') == told(walk) == told(tmp_path / 'copy')
    assert bags.extras(tmp_path / 'copy') == EXTRAS
    with BagReader(walk) as one, BagReader(tmp_path / 'copy') as other:
        assert one.connections == other.connections


def test_progress_is_the_share_of_bytes_that_were_read(walk, tmp_path):
    shares = []
    with BagReader(walk) as bag:
        edit([bag], tmp_path / 'copy', Edit(), shares.append)
        size = bag.files[0].path.stat().st_size
        lengths = [chunk.length for chunk in bag.files[0].chunks]
    assert shares == [sum(lengths[: k + 1]) / size for k in range(len(lengths))]
    with BagWriter(tmp_path / 'packed', chunk_size=2000) as bag:
        topic = bag.add_topic('/a', TEXT, 'string data', type_hash='')
        for stamp in (0, 20, 10, 30):  # two chunks that overlap: their messages are read unpacked
            bag.write(topic, stamp, text('x' * 1500))
    with BagReader(tmp_path / 'packed') as bag:
        edit([bag], tmp_path / 'ordered', Edit(ordered=True), shares.append)
    assert shares[-1] == 1.0


@pytest.mark.parametrize(('what', 'times'), [({}, 1), ({'spans': ((0, 2**64),)}, 0)])
def test_the_crc_of_the_whole_counts_where_all_is_wanted(walk, tmp_path, monkeypatch, what, times):
    asked = []
    monkeypatch.setattr(McapFile, 'require_whole', lambda file: asked.append(file.path))
    edited(tmp_path / 'copy', [walk], **what)
    assert len(asked) == times


def test_some_topics_are_gathered_into_few_chunks_and_the_others_are_not_described(walk, tmp_path):
    report = edited(tmp_path / 'a', [walk], topics=Selection(topics=('/a', '/map')))
    assert (report.copied, report.made) == (0, 1)
    assert judged(tmp_path / 'a') == told(walk, topics=['/a', '/map'])
    assert bags.extras(tmp_path / 'a') == EXTRAS
    with BagReader(tmp_path / 'a') as bag:
        assert set(bag.topics) == {'/a', '/map'}
        assert bag.topics['/map'].latched


def test_a_cut_copies_what_lies_within_and_begins_with_what_was_latched(walk, tmp_path):
    span = (101 * SECOND, 103 * SECOND)
    report = edited(tmp_path / 'cut', [walk], spans=(span,), latched=True)
    assert report.copied > 0
    assert report.made in (2, 3)
    inside = [m for m in told(walk) if span[0] <= m[1] < span[1]]
    assert judged(tmp_path / 'cut') == [('/map', span[0], 7, 1, text('map')), *inside]
    assert bags.extras(tmp_path / 'cut') == EXTRAS


def test_what_was_latched_is_told_once_for_several_cuts_and_again_when_it_changed(tmp_path):
    with BagWriter(tmp_path / 'bag') as bag:
        state = bag.add_topic('/state', TEXT, 'string data', type_hash='', qos=bags.LATCHED)
        talk = bag.add_topic('/talk', TEXT, 'string data', type_hash='')
        for i in range(100):
            if i in (0, 50):
                bag.write(state, i * SECOND, text(f'state {i}'))
            bag.write(talk, i * SECOND, text(str(i)))
    spans = tuple((s * SECOND, (s + 2) * SECOND) for s in (10, 30, 70))
    edited(tmp_path / 'cut', [tmp_path / 'bag'], spans=spans, latched=True)
    assert [(t, stamp // SECOND, data) for t, stamp, _, _, data in judged(tmp_path / 'cut')] == [
        ('/state', 10, text('state 0')), ('/talk', 10, text('10')), ('/talk', 11, text('11')),
        ('/talk', 30, text('30')), ('/talk', 31, text('31')),
        ('/state', 70, text('state 50')), ('/talk', 70, text('70')), ('/talk', 71, text('71')),
    ]  # fmt: skip


def test_static_transforms_of_all_publishers_are_carried_though_no_quality_is_told(tmp_path):
    with BagWriter(tmp_path / 'bag') as bag:
        static = bag.add_topic('/oak/tf_static', TEXT, 'string data', type_hash='', qos=())
        for i in range(3):
            bag.write(static, i * SECOND, text(f'part {i}'))
        bag.write(static, 9 * SECOND, text('late'))
    edited(tmp_path / 'cut', [tmp_path / 'bag'], spans=((5 * SECOND, 2**64),), latched=True)
    assert [m[4] for m in judged(tmp_path / 'cut')] == [
        *(text(f'part {i}') for i in range(3)), text('late'),
    ]  # fmt: skip


def test_halves_merged_are_the_whole_and_what_both_have_is_kept_once(walk, tmp_path):
    middle = 102 * SECOND + 5
    halves = {'one': ((0, middle),), 'two': ((middle, 2**64),)}
    for name, spans in halves.items():
        edited(tmp_path / name, [walk], spans=spans)
    report = edited(tmp_path / 'whole', [tmp_path / name for name in halves])
    assert report.made == 0
    assert judged(tmp_path / 'whole') == told(walk)
    assert bags.extras(tmp_path / 'whole') == EXTRAS


def test_topics_of_other_numbers_are_numbered_anew_and_those_alike_become_one(walk, tmp_path):
    write(tmp_path / 'other', topics=('/c', '/x'), start=102, extras=False)
    report = edited(tmp_path / 'both', [walk, tmp_path / 'other'])
    assert report.copied > 0
    assert report.made > 0
    expected = sorted([*told(walk), *told(tmp_path / 'other')], key=lambda m: m[1])
    assert sorted(judged(tmp_path / 'both')) == sorted(expected)
    with BagReader(tmp_path / 'both') as bag:
        topics = [c.topic for c in bag.connections]
        assert sorted(topics) == ['/a', '/b', '/c', '/map', '/x']


def test_a_topic_with_two_types_keeps_both(walk, tmp_path):
    with BagWriter(tmp_path / 'odd') as bag:
        handle = bag.add_topic('/a', 'a/msg/Odd', 'int8 x', type_hash='')
        bag.write(handle, 5, b'\0\1\0\0\1')
    edited(tmp_path / 'both', [walk, tmp_path / 'odd'])
    with BagReader(tmp_path / 'both') as bag:
        kinds = {m.connection.type for m in bag.messages(['/a'])}
    assert kinds == {TEXT, 'a/msg/Odd'}
    judged(tmp_path / 'both')


@pytest.mark.parametrize('compression', ['', 'lz4', 'zstd'])
def test_chunks_are_compressed_anew_unless_they_are_so_already(walk, tmp_path, compression):
    report = edited(tmp_path / 'new', [walk], compression=compression)
    assert (report.made == 0) == (compression == 'zstd')
    assert judged(tmp_path / 'new') == told(walk)


def test_messages_are_put_in_order_and_what_is_in_order_stays(tmp_path):
    with BagWriter(tmp_path / 'bag', chunk_size=200, compression='none') as bag:
        handle = bag.add_topic('/a', TEXT, 'string data', type_hash='')
        for i in (0, 1, 2, 3, 20, 10, 21, 22, 11, 12, 13, 23, 30, 31, 32, 33, 40, 42, 41, 43):
            bag.write(handle, i * SECOND, text(f'{i:040d}'), i, i)
    report = edited(tmp_path / 'sorted', [tmp_path / 'bag'], ordered=True)
    assert report.copied > 0
    assert report.made > 0
    file = next((tmp_path / 'sorted').glob('*.mcap')).read_bytes()
    places = [file.find(m[4]) for m in judged(tmp_path / 'sorted')]
    assert len(places) == 20
    assert all(a < b for a, b in pairwise(places))


def test_a_split_bag_is_the_bag_and_each_file_has_its_time(walk, tmp_path):
    parts = tuple((100 * SECOND + i * SECOND, 101 * SECOND + i * SECOND) for i in (0, 1, 2, 3, 9))
    report = edited(tmp_path / 'files', [walk], parts=parts)
    assert report.files == 4
    assert judged(tmp_path / 'files') == told(walk) == told(tmp_path / 'files')
    assert bags.extras(tmp_path / 'files') == EXTRAS
    for i, file in enumerate(sorted((tmp_path / 'files').glob('*.mcap'))):
        with BagReader(file) as bag:
            assert parts[i][0] <= bag.start <= bag.end < parts[i][1]


def test_of_each_part_only_what_is_wanted_is_kept(walk, tmp_path):
    parts = tuple((100 * SECOND + i * SECOND, 101 * SECOND + i * SECOND) for i in range(4))
    spans = ((100 * SECOND + SECOND // 2, 102 * SECOND), (103 * SECOND, 200 * SECOND))
    report = edited(tmp_path / 'files', [walk], parts=parts, spans=spans)
    assert report.files == 3
    wanted = [m for m in told(walk) if any(a <= m[1] < b for a, b in spans)]
    assert judged(tmp_path / 'files') == wanted


def test_a_file_size_begins_new_files_between_chunks(walk, tmp_path):
    report = edited(tmp_path / 'files', [walk], file_size=1500)
    assert report.files > 1
    assert report.made == 0
    assert judged(tmp_path / 'files') == told(walk)


def test_no_more_is_in_memory_than_may_be(monkeypatch):
    """With room for 10: 4 and 6 fit; 1 waits for 4, 20 for all before it, and so does 3."""
    monkeypatch.setattr(engine, '_AHEAD', 10)
    done, asked, shown = [], [], []

    def steps():
        for size in (4, 6, 1, 20, 3):
            asked.append(len(done))
            yield Step(0, size, 2 * size, lambda: None, partial(done.append, size))

    engine.EditWork(None, '', 0).do(steps(), shown.append)
    assert done == [4, 6, 1, 20, 3]
    assert asked == [0, 0, 0, 1, 3]
    assert shown == [8, 20, 22, 62, 68]


def test_channels_that_are_described_in_chunks_by_other_writers(tmp_path):
    """What mcap's own writer puts there stays, as long as it holds in the new file."""
    with (tmp_path / 'a.mcap').open('wb') as stream:
        writer = Writer(stream, chunk_size=200)
        writer.start('ros2', 'x')
        schema = writer.register_schema(TEXT, 'ros2msg', b'string data')
        channels = [writer.register_channel(name, 'cdr', schema) for name in ('/a', '/b')]
        for i in range(20):
            writer.add_message(channels[i % 2], i, text(f'word {i}'), i, i)
        writer.finish()
    path = tmp_path / 'a.mcap'
    assert edited(tmp_path / 'copy', [path]).made == 0
    edited(tmp_path / 'a', [path], topics=Selection(topics=('/a',)))
    write(tmp_path / 'other', topics=('/z',), extras=False)
    edited(tmp_path / 'both', [tmp_path / 'other', path])
    assert judged(tmp_path / 'copy') == told(path)
    assert judged(tmp_path / 'a') == told(path, topics=['/a'])
    assert sorted(judged(tmp_path / 'both')) == sorted([*told(path), *told(tmp_path / 'other')])
    streamed = (tmp_path / 'a' / 'a_0.mcap').read_bytes()
    assert b'/b' not in streamed


@pytest.mark.parametrize('mode', [None, CompressionMode.MESSAGE, CompressionMode.FILE])
@pytest.mark.parametrize('storage', [StoragePlugin.SQLITE3, StoragePlugin.MCAP])
def test_bags_of_other_storages_become_chunks(tmp_path, mode, storage):
    store = get_typestore(Stores.ROS2_JAZZY)
    writer = RosbagsWriter(tmp_path / 'bag', version=9, storage_plugin=storage)
    if mode is not None and not (mode == CompressionMode.MESSAGE and storage.name == 'MCAP'):
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connection = writer.add_connection('/a', TEXT, typestore=store)
        for i in range(10):
            writer.write(connection, i + 1, text(f'word {i}'))
    report = edited(tmp_path / 'new', [tmp_path / 'bag'], spans=((3, 9),))
    assert report.messages == 6
    assert [m[4] for m in judged(tmp_path / 'new')] == [text(f'word {i}') for i in range(2, 8)]


def damaged_places(data):
    """Return bytes of a file, one in its chunks, one in its attachment, one in its metadata."""
    return {
        'chunk': data.find(b'word 3'), 'attachment': data.find(b'turret: 1'),
        'index': data.find(b'\x07', data.find(b'word 3')),
    }  # fmt: skip


@pytest.mark.parametrize('what', ['chunk', 'attachment'])
def test_damage_is_never_copied(tmp_path, what):
    walk = write(tmp_path / 'walk', compression='none')
    file = next(walk.glob('*.mcap'))
    data = bytearray(file.read_bytes())
    data[damaged_places(data)[what]] ^= 1
    file.write_bytes(data)
    with pytest.raises(DamagedBagError, match='agv bag recover') as caught:
        edited(tmp_path / 'copy', [walk])
    assert caught.value.path == file
    assert 0 < caught.value.offset < len(data)


def test_damage_elsewhere_is_no_matter(tmp_path):
    walk = write(tmp_path / 'walk', compression='none')
    file = next(walk.glob('*.mcap'))
    data = bytearray(file.read_bytes())
    data[data.find(b'word 3')] ^= 1
    file.write_bytes(data)
    edited(tmp_path / 'late', [walk], spans=((103 * SECOND, 2**64),))
    assert len(judged(tmp_path / 'late')) == 10


def test_a_torn_bag_is_refused(walk, tmp_path):
    file = next(walk.glob('*.mcap'))
    torn = tmp_path / 'torn.mcap'
    torn.write_bytes(file.read_bytes()[:1000])
    with pytest.raises(SourceError, match='agv bag recover'):
        edited(tmp_path / 'copy', [torn])
    assert not (tmp_path / 'copy').exists()


def test_an_index_that_hides_messages_is_refused(tmp_path):
    """As many messages as the statistics tell, but one of them is told twice, and one never."""
    walk = write(tmp_path / 'walk', compression='none', count=4)
    file = next(walk.glob('*.mcap'))
    with BagReader(walk) as bag:
        chunk = bag.files[0].chunks[0]
        at = min(chunk.indexes.values())
    data = bytearray(file.read_bytes())
    entries = at + 9 + 2 + 4
    data[entries + 16 : entries + 32] = data[entries : entries + 16]
    file.write_bytes(data)
    with pytest.raises(DamagedBagError, match='in this chunk, messages'):
        edited(tmp_path / 'copy', [walk])


@settings(max_examples=15)
@given(
    stamps=st.lists(st.lists(st.integers(0, 30), max_size=12), min_size=1, max_size=3),
    span=st.tuples(st.integers(0, 31), st.integers(0, 31)),
    ordered=st.booleans(),
    topics=st.sets(st.sampled_from(['/a', '/b', '/c']), min_size=1),
)
def test_any_edit_gives_what_reading_gives(tmp_path_factory, stamps, span, ordered, topics):
    """Law: the messages of an edit are those that one would read, one by one."""
    folder = tmp_path_factory.mktemp('law')
    names = ['/a', '/b', '/c']
    expected = []
    for i, times in enumerate(stamps):
        with BagWriter(folder / str(i), chunk_size=100, compression='none') as bag:
            order = names[i:] + names[:i]
            handles = {n: bag.add_topic(n, TEXT, 'string data', type_hash='') for n in order}
            for k, stamp in enumerate(times):
                bag.write(handles[names[k % 3]], stamp, text(f'{i} {k}'), k, k)
                if names[k % 3] in topics and min(span) <= stamp < max(span):
                    expected.append((names[k % 3], stamp, k, k, text(f'{i} {k}')))
    edited(
        folder / 'new', [folder / str(i) for i in range(len(stamps))],
        topics=Selection(topics=tuple(topics)), spans=((min(span), max(span)),), ordered=ordered,
    )  # fmt: skip
    found = told(folder / 'new')
    assert sorted(found) == sorted(expected)
    if ordered:
        data = next((folder / 'new').glob('*.mcap')).read_bytes()
        places = [data.find(m[4]) for m in found]
        assert places == sorted(places)
