"""The description of a bag: what others read of it, and that it is whole or not there."""

from __future__ import annotations

import pytest
import yaml

from agv_motion.bag.metadata import NEVER, FileSummary, Topic, describe, inside_mcap, save
from agv_motion.bag.quality_of_service import OfferedQos

TOPIC = Topic('/a', 'a/msg/A', 'int8 x', 'RIHS01_1', (OfferedQos(),))
FILES = [FileSummary('x_0.mcap', 5, 9, 3), FileSummary('x_1.mcap', 0, 0, 0),
         FileSummary('x_2.mcap', 7, 30, 4)]  # fmt: skip


def described(files, topics=((TOPIC, 7),)):
    return yaml.safe_load(describe(files, topics, 'jazzy'))['rosbag2_bagfile_information']


def test_the_bag_spans_the_files_that_have_messages():
    found = described(FILES)
    assert found['starting_time'] == {'nanoseconds_since_epoch': 5}
    assert found['duration'] == {'nanoseconds': 25}
    assert found['message_count'] == 7
    assert found['relative_file_paths'] == ['x_0.mcap', 'x_1.mcap', 'x_2.mcap']
    assert (found['version'], found['storage_identifier']) == (9, 'mcap')
    empty = found['files'][1]
    assert empty['starting_time'] == {'nanoseconds_since_epoch': NEVER}
    assert empty['duration'] == {'nanoseconds': 0}


def test_a_bag_without_messages_began_never():
    found = described([], ())
    assert found['starting_time'] == {'nanoseconds_since_epoch': NEVER}
    assert found['duration'] == {'nanoseconds': 0}
    assert found['topics_with_message_count'] == []


def test_topics_have_their_numbers_and_profiles():
    ((topic,),) = [described(FILES)['topics_with_message_count']]
    assert topic['message_count'] == 7
    assert topic['topic_metadata']['type_description_hash'] == 'RIHS01_1'
    (profile,) = topic['topic_metadata']['offered_qos_profiles']
    assert OfferedQos.from_entries(profile) == OfferedQos()


def test_inside_a_file_it_stands_without_its_heading():
    text = describe(FILES, [(TOPIC, 7)], 'jazzy')
    assert inside_mcap(text).startswith('version: 9\nstorage_identifier: mcap\n')
    assert yaml.safe_load(inside_mcap(text)) == described(FILES)


@pytest.mark.parametrize('name', ['words ' * 40, ' "a"\n\n  b: c\n', '#\t\u2028é', '- x: |\n  y'])
def test_inside_a_file_long_and_odd_names_are_the_same(name):
    text = describe([FileSummary(name, 5, 9, 3)], [(TOPIC._replace(name=name, type=name), 3)])
    whole = yaml.safe_load(text)['rosbag2_bagfile_information']
    assert yaml.safe_load(inside_mcap(text)) == whole
    assert whole['files'][0]['path'] == name


def test_it_is_saved_whole_or_not_at_all(tmp_path, monkeypatch):
    save(tmp_path, 'old')
    monkeypatch.setattr('os.fsync', lambda _: (_ for _ in ()).throw(OSError(28, 'full')))
    with pytest.raises(OSError, match='full'):
        save(tmp_path, 'new')
    assert [path.name for path in tmp_path.iterdir()] == ['metadata.yaml']
    assert (tmp_path / 'metadata.yaml').read_text() == 'old'


def test_a_file_that_cannot_even_be_begun_is_told_as_the_disk_told_it(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise OSError(28, 'full')

    monkeypatch.setattr('pathlib.Path.open', refuse)
    with pytest.raises(OSError, match='full'):
        save(tmp_path, 'new')
