"""The metadata tells of every file that is whole, and names the one in the making."""

from __future__ import annotations

import pytest
import yaml

from agv_motion.bag.finished_files import FinishedFiles
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic


class Bag:
    """Writes files of one message a topic that it knows then."""

    def __init__(self, folder):
        self.folder, self.files = folder, FinishedFiles(folder, 'jazzy')

    def topic(self, name):
        self.files.add_topic(Topic(name, 'a/msg/A', 'int8 x', '', ()))

    def begin(self, number, stamp):
        writer = McapWriter(self.folder / f'x_{number}.mcap', '')
        for topic in self.files.topics:
            channel = writer.add_topic(topic)
            writer.write(channel, stamp, b'\0\1\0\0\1', stamp, 0)
        writer.flush()
        return writer

    @property
    def described(self):
        return yaml.safe_load((self.folder / 'metadata.yaml').read_text())[
            'rosbag2_bagfile_information'
        ]


@pytest.fixture
def bag(tmp_path):
    """Two whole files: one message in the first, two in the second, whose topic came later."""
    bag = Bag(tmp_path)
    bag.topic('/a')
    bag.files.close(bag.begin(0, 5))
    bag.topic('/b')
    bag.files.close(bag.begin(1, 9))
    return bag


def test_whole_files_are_described(bag):
    found = bag.described
    assert found['relative_file_paths'] == ['x_0.mcap', 'x_1.mcap']
    counts = [topic['message_count'] for topic in found['topics_with_message_count']]
    assert (counts, found['message_count']) == ([2, 1], 3)
    assert found['duration'] == {'nanoseconds': 4}


def test_the_one_in_the_making_is_named_so_that_nobody_misses_it(bag):
    present = bag.begin(2, 12)
    bag.files.save(present)
    found = bag.described
    assert found['relative_file_paths'][-1] == 'x_2.mcap'
    assert found['message_count'] == 3
    assert bag.files.counts(present) == [3, 2]
    present.abandon()
    assert bag.files.counts(present) == [2, 1]


def test_the_oldest_is_deleted_and_counted(bag):
    present = bag.begin(2, 12)
    assert bag.files.drop_oldest(present)
    assert not (bag.folder / 'x_0.mcap').exists()
    assert bag.described['relative_file_paths'] == ['x_1.mcap', 'x_2.mcap']
    assert bag.files.deleted == [1, 0]
    assert bag.files.drop_oldest(present)
    assert bag.files.deleted == [2, 1]
    assert not bag.files.drop_oldest(present)
    present.abandon()


def test_a_file_that_somebody_else_deleted_is_gone_too(bag, monkeypatch):
    present, save, failures = bag.begin(2, 12), bag.files.save, [OSError(28, 'full')]
    (bag.folder / 'x_0.mcap').unlink()
    assert bag.files.drop_oldest(present)
    (bag.folder / 'x_1.mcap').unlink()

    def full_at_first(writer):
        if failures:
            raise failures.pop()
        save(writer)

    monkeypatch.setattr(bag.files, 'save', full_at_first)
    assert bag.files.drop_oldest(present)
    assert bag.described['relative_file_paths'] == ['x_2.mcap']
    present.abandon()


def test_where_the_disk_is_too_full_to_describe_it_is_deleted_first(bag, monkeypatch):
    present, save = bag.begin(2, 12), bag.files.save

    def full_at_first(writer):
        if (bag.folder / 'x_0.mcap').exists():
            raise OSError(28, 'No space left on device')
        save(writer)

    monkeypatch.setattr(bag.files, 'save', full_at_first)
    assert bag.files.drop_oldest(present)
    assert bag.described['relative_file_paths'] == ['x_1.mcap', 'x_2.mcap']
    present.abandon()
