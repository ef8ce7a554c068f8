"""Which files make a bag: what lies in the folder counts, and what is no bag is told."""

from __future__ import annotations

import gzip
import os
import shutil
import sqlite3
import tarfile
from contextlib import closing

import pytest
import yaml
import zstandard
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.bag_files import find, unpack_file
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError

TEXT = 'std_msgs/msg/String'
DATA = b'\x00\x01\x00\x00\x01\x00\x00\x00\x00'


def split_bag(path, files=4):
    """Write a bag of some files with a message each; return its folder."""
    with BagWriter(path) as writer:
        topic = writer.add_topic('/a', TEXT, 'string data', type_hash='')
        for i in range(files):
            writer.write(topic, i, DATA)
            if i < files - 1:
                writer.split()
    return path


def told(path):
    """Return stamps of a bag, what is amiss, and whether something is lost."""
    with BagReader(path) as bag:
        return [m.stamp for m in bag.messages()], ' '.join(map(str, bag.problems)), bag.lossy


def forget(bag, count):
    """Let the metadata name only the first files, as when a recording is killed."""
    path = bag / 'metadata.yaml'
    description = yaml.safe_load(path.read_text())
    entries = description['rosbag2_bagfile_information']
    entries['relative_file_paths'] = entries['relative_file_paths'][:count]
    entries['message_count'] = count
    path.write_text(yaml.safe_dump(description))


def test_a_file_that_the_metadata_does_not_name_is_read_and_told(tmp_path):
    bag = split_bag(tmp_path / 'bag')
    forget(bag, 3)
    stamps, problems, lossy = told(bag)
    assert stamps == [0, 1, 2, 3]
    assert 'does not name bag_3.mcap, which lies there; it is read' in problems
    assert not lossy
    with BagWriter(tmp_path / 'saved') as writer:
        recovery = Recovery(writer)
        recovery.save(bag)
    assert recovery.messages == 4


def test_a_file_that_is_gone_is_a_loss(tmp_path):
    bag = split_bag(tmp_path / 'bag')
    (bag / 'bag_1.mcap').unlink()
    stamps, problems, lossy = told(bag)
    assert stamps == [0, 2, 3]
    assert 'it names bag_1.mcap, which is not there' in problems
    assert 'it tells of 4 messages, where 3 are' in problems
    assert lossy


def test_renamed_files_are_read_and_told(tmp_path):
    bag = split_bag(tmp_path / 'bag', 3)
    for number in range(3):
        (bag / f'bag_{number}.mcap').rename(bag / f'walk_{number}.mcap')
    stamps, problems, lossy = told(bag)
    assert stamps == [0, 1, 2]
    assert 'names bag_2.mcap, which is not there' in problems
    assert 'does not name walk_2.mcap, which lies there' in problems
    assert not lossy


def test_copies_are_read_once(tmp_path):
    bag = split_bag(tmp_path / 'bag', 2)
    shutil.copy(bag / 'bag_1.mcap', bag / 'bag_1 (copy).mcap')
    (bag / 'bag_0.mcap.zstd').write_bytes(zstandard.compress((bag / 'bag_0.mcap').read_bytes()))
    stamps, problems, lossy = told(bag)
    assert stamps == [0, 1]
    assert 'bag_1 (copy).mcap is a copy of bag_1.mcap' in problems
    assert not lossy


@pytest.mark.parametrize('suffix', ['.mcap.zstd', '.mcap.zst', '.mcap'])
def test_files_compressed_as_a_whole_are_known_by_their_bytes(tmp_path, suffix):
    bag = split_bag(tmp_path / 'bag', 1)
    packed = zstandard.compress((bag / 'bag_0.mcap').read_bytes())
    (tmp_path / 'folder').mkdir()
    file = tmp_path / 'folder' / f'bag_0{suffix}'
    file.write_bytes(packed)
    assert told(file)[0] == [0]
    assert told(tmp_path / 'folder')[0] == [0]


FOREIGN = {
    b'#ROSBAG V2.0\n': 'is a bag of ROS 1: rosbags-convert',
    b'version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n': 'git lfs pull',
    gzip.compress(b'abc', mtime=0): 'compressed by gzip',
    b'PK\x03\x04': 'a zip archive',
    b'rosbag2_bagfile_information:\n': 'give the folder',
    b'time,x\n1,2\n': 'is no',
}


@pytest.mark.parametrize('name', ['bag_0.mcap', 'bag.db3', 'walk.bag'])
@pytest.mark.parametrize('content', FOREIGN, ids=lambda content: str(content[:8]))
def test_what_is_no_bag_is_told_what_it_is(tmp_path, content, name):
    file = tmp_path / name
    file.write_bytes(content.ljust(100, b'\n'))
    expected = FOREIGN[content]
    if name == 'bag.db3' and expected == 'is no':
        expected = 'cannot be read as a bag in sqlite3'
    with pytest.raises(SourceError, match=expected) as caught:
        BagReader(file)
    assert str(file) in str(caught.value)
    with pytest.raises(SourceError) as caught:
        BagReader(tmp_path)
    assert expected == 'is no' or expected in str(caught.value)


def test_an_archive_and_a_folder_of_bags_are_told(tmp_path):
    bag = split_bag(tmp_path / 'walks' / 'monday', 1)
    with tarfile.open(tmp_path / 'bag.mcap', 'w') as archive:
        archive.add(bag)
    with pytest.raises(SourceError, match='is a tar archive'):
        BagReader(tmp_path / 'bag.mcap')
    for day in range(6):
        shutil.copytree(bag, tmp_path / 'walks' / f'day{day}')
    with pytest.raises(SourceError, match='has bags in it: give one of them, as ') as caught:
        find(tmp_path / 'walks')
    named = str(caught.value).split(', ')[2:]
    assert [name[-4:] for name in named] == [f'day{n}' for n in range(5)]


def sqlite_bag(path):
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        topic = writer.add_connection('/a', TEXT, typestore=store)
        for i in range(10):
            writer.write(topic, i, DATA)
    return path / f'{path.name}.db3'


def killed_while_writing(file, rows):
    """Append rows that stay in the write-ahead log, as of a recorder that was killed."""
    copies = file.parent / 'copies'
    copies.mkdir()
    with closing(sqlite3.connect(file)) as database:
        database.execute('pragma journal_mode = wal')
        database.execute('pragma wal_autocheckpoint = 0')
        for i in range(rows):
            values = (1, 10 + i, DATA)
            database.execute(
                'insert into messages (topic_id, timestamp, data) values (?, ?, ?)', values
            )
        database.commit()
        for part in (file, file.with_name(f'{file.name}-wal')):
            shutil.copy(part, copies)
    for part in copies.iterdir():
        shutil.move(part, file.parent / part.name)
    copies.rmdir()


def test_the_log_of_a_sqlite_file_is_read_and_the_folder_left_as_it_is(tmp_path):
    file = sqlite_bag(tmp_path / 'bag')
    killed_while_writing(file, 7)
    before = {path: path.read_bytes() for path in file.parent.iterdir()}
    assert told(file.parent)[0] == list(range(17))
    assert told(file)[0] == list(range(17))
    with BagWriter(tmp_path / 'saved') as writer:
        recovery = Recovery(writer)
        recovery.save(file)
    assert recovery.messages == 17
    assert not recovery.problems
    assert {path: path.read_bytes() for path in file.parent.iterdir()} == before


@pytest.mark.parametrize('name', ['a#b', 'why?', '50%25', 'a b%', 'ä&c=d'])
def test_names_that_mean_something_in_a_uri(tmp_path, name):
    file = sqlite_bag(tmp_path / 'bag')
    folder = tmp_path / name
    file.parent.rename(folder)
    file = (folder / file.name).rename(folder / f'{name}.db3')
    assert told(file)[0] == list(range(10))
    with BagWriter(tmp_path / 'saved') as writer:
        recovery = Recovery(writer)
        recovery.save(file)
    assert recovery.messages == 10


def test_a_file_alone_is_what_the_metadata_beside_it_says_of_it(tmp_path):
    bag = split_bag(tmp_path / 'bag', 1)
    text = (bag / 'metadata.yaml').read_text()
    shutil.copy(bag / 'bag_0.mcap', bag / 'other.mcap')
    for mode, packed in (('MESSAGE', True), ('FILE', False), ('NONE', False)):
        told_so = text.replace('compression_mode: ""', f'compression_mode: {mode}')
        told_so = told_so.replace("compression_mode: ''", f'compression_mode: {mode}')
        assert mode in told_so
        (bag / 'metadata.yaml').write_text(told_so)
        assert find(bag / 'bag_0.mcap') == ([bag / 'bag_0.mcap'], packed, (), 0)
        assert find(bag / 'other.mcap') == ([bag / 'other.mcap'], False, (), 0)
        assert (find(bag).messages_compressed, find(bag).messages) == (packed, 1)


def test_a_file_is_unpacked_under_its_name(tmp_path):
    (tmp_path / 'new').mkdir()
    for name, unpacked in (('a.mcap.zstd', 'a.mcap'), ('a.mcap.zst', 'a.mcap'), ('b.db3', 'b.db3')):
        (tmp_path / name).write_bytes(zstandard.compress(name.encode()))
        file = unpack_file(tmp_path / name, tmp_path / 'new')
        assert (file, file.read_text()) == (tmp_path / 'new' / unpacked, name)


def folder_with(folder, named, **contents):
    """Make a folder of files, of which the metadata names some."""
    folder.mkdir()
    entries = {'rosbag2_bagfile_information': {'relative_file_paths': named}}
    (folder / 'metadata.yaml').write_text(yaml.safe_dump(entries))
    for name, content in contents.items():
        (folder / name.replace('__', '.')).write_bytes(content)
    return folder


@pytest.mark.parametrize(('named', 'contents', 'files'), [
    (['a.db3'], {'a__db3': b'1', 'extras__mcap': b'2', 'b__db3': b'33'}, 'a.db3 b.db3 extras.mcap'),
    (['a.db3', 'extras.mcap'], {'a__db3': b'1', 'extras__mcap': b'2'}, 'a.db3 extras.mcap'),
    (['a.mcap'], {'a__mcap': b'1', 'extras__mcap': b'2'}, 'a.mcap extras.mcap'),
    (['a.mcap'], {'a__mcap': b'1', 'b__db3': b'2'}, 'a.mcap'),
    (['a.mcap'], {'a__mcap': b'1', 'b__mcap': b'1', 'c__mcap': b'3'}, 'a.mcap c.mcap'),
    (['a.mcap'], {'a__mcap': b'', 'b__mcap': b''}, 'a.mcap b.mcap'),
    ([], {'bag_10__mcap': b'1', 'bag_2__mcap': b'2', 'bag_1__mcap': b'3'},
     'bag_1.mcap bag_2.mcap bag_10.mcap'),
    ([], {'x__mcap': b'1', 'x__mcap0__mcap': b'2'}, 'x.mcap x.mcap0.mcap'),
])  # fmt: skip
def test_files_that_belong_to_a_bag_each_once_and_in_order(tmp_path, named, contents, files):
    folder = folder_with(tmp_path / 'bag', named, **contents)
    found = find(folder)
    assert [path.name for path in found.paths] == files.split()
    assert all(str(p).startswith(f'{folder}/metadata.yaml, byte 0: ') for p in found.problems)
    assert all(problem.harmless for problem in found.problems)


def test_a_name_that_no_file_can_have_is_not_there(tmp_path):
    folder = folder_with(
        tmp_path / 'bag', ['a.mcap', 'a\0b.mcap', 'x' * 300 + '.mcap'], a__mcap=b'1'
    )
    found = find(folder)
    assert ([path.name for path in found.paths], found.messages) == (['a.mcap'], 0)
    assert [problem.harmless for problem in found.problems] == [False, False]


def test_files_of_one_size_and_time_are_no_copies_for_that(tmp_path):
    folder = folder_with(tmp_path / 'bag', ['a.mcap'], a__mcap=b'1', b__mcap=b'2')
    for name in 'ab':
        os.utime(folder / f'{name}.mcap', ns=(1, 1))
    assert len(find(folder).paths) == 2


def test_a_folder_without_files_of_bags_is_told_so_and_no_more(tmp_path):
    folder = folder_with(tmp_path / 'bag', ['a.mcap'])
    (folder / 'inner').mkdir()
    with pytest.raises(SourceError, match=r'it has no \.mcap and no \.db3 file$'):
        find(folder)


def test_a_file_that_is_named_twice_is_read_once(tmp_path):
    bag = split_bag(tmp_path / 'bag', files=3)
    path = bag / 'metadata.yaml'
    description = yaml.safe_load(path.read_text())
    description['rosbag2_bagfile_information']['relative_file_paths'].insert(1, 'bag_0.mcap')
    path.write_text(yaml.safe_dump(description))
    assert told(bag) == ([0, 1, 2], '', False)


def test_a_compressed_file_is_named_as_the_user_knows_it(tmp_path):
    bag = split_bag(tmp_path / 'bag', files=1)
    data = (bag / 'bag_0.mcap').read_bytes()
    packed = tmp_path / 'walk.mcap.zstd'
    packed.write_bytes(zstandard.compress(data[:250]))
    with BagReader(packed) as reader:
        assert [file.path for file in reader.files] == [packed]
        assert all('walk.mcap.zstd, byte' in str(problem) for problem in reader.problems)
        assert reader.lossy
    packed.write_bytes(zstandard.compress(data)[:20])
    with pytest.raises(SourceError, match=r'walk\.mcap\.zstd, byte 20: the file ends before'):
        BagReader(packed)
