"""One file in the making: both ways of writing, chunks that are dropped, and a disk that fills."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.mcap.records import Attachment
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic
from agv_motion.bag.reader import BagReader
from agv_motion.errors import SignalError

A, B = (Topic(name, 'a/msg/A', 'int8 x', '', ()) for name in ('/a', '/b'))


def written(path, fill, compression=''):
    writer = McapWriter(path, compression)
    for topic in (A, B):
        writer.add_topic(topic)
    fill(writer)
    writer.close({'note': 'done'})
    return writer


def read(path):
    with BagReader(path) as bag:
        assert bag.problems == []
        return [(m.connection.topic, m.stamp, m.data, m.publish) for m in bag.messages()]


@pytest.mark.parametrize('compression', ['', 'lz4', 'zstd'])
def test_one_by_one_and_together_give_the_same_bytes(tmp_path, compression):
    channels, stamps = [1, 2, 1, 1], [5, 6, 6, 9]
    data = [b'\0\1\0\0%d' % i for i in range(4)]

    def single(writer):
        for one in zip(channels, stamps, data, stamps, [0] * 4, strict=True):
            writer.write(*one)
        assert (writer.waiting, writer.chunk_start) == (4, 5)
        writer.flush()

    def several(writer):
        columns = np.array(channels, np.uint16), np.array(stamps, np.uint64)
        writer.write_several(columns[0][:1], columns[1][:1], data[:1])
        writer.write_several(columns[0][1:], columns[1][1:], data[1:])
        assert (writer.waiting, writer.chunk_start) == (4, 5)
        writer.flush()

    one, other = tmp_path / 'one.mcap', tmp_path / 'other.mcap'
    assert written(one, single, compression).counts == [3, 1]
    written(other, several, compression)
    assert one.read_bytes() == other.read_bytes()
    topics = ['/a', '/b', '/a', '/a']
    assert read(one) == list(zip(topics, stamps, data, stamps, strict=True))


def test_a_chunk_that_is_dropped_was_never_there(tmp_path):
    def fill(writer, *, more):
        writer.write(1, 5, b'\0\1\0\0a', 5, 0)
        writer.flush()
        if more:
            writer.write(2, 9, b'\0\1\0\0b', 9, 0)
            writer.flush()
            writer.keep(Attachment(9, 9, 'late', '', b''))
            assert writer.drop_chunk()
        assert (writer.start, writer.end, writer.counts) == (5, 5, [1, 0])

    one, other = tmp_path / 'one.mcap', tmp_path / 'other.mcap'
    written(one, lambda writer: fill(writer, more=False))
    written(other, lambda writer: fill(writer, more=True))
    assert one.read_bytes() == other.read_bytes()


def test_without_chunks_there_is_none_to_drop(tmp_path):
    writer = written(tmp_path / 'x.mcap', lambda writer: not writer.drop_chunk())
    assert writer.closed
    with BagReader(writer.path) as bag:
        assert (bag.message_count, bag.problems) == (0, [])


def test_what_is_discarded_is_not_written(tmp_path):
    def fill(writer):
        writer.write(1, 5, b'\0\1\0\0a', 5, 0)
        writer.discard()
        writer.write(1, 7, b'\0\1\0\0c', 7, 0)
        writer.flush()
        writer.flush()

    path = tmp_path / 'x.mcap'
    written(path, fill)
    assert read(path) == [('/a', 7, b'\0\1\0\0c', 7)]


@pytest.mark.parametrize('numbers', [(-1, 0, 0), (0, 2**64, 0), (0, 0, 2**32)])
def test_a_number_without_room_is_refused_and_nothing_is_lost(tmp_path, numbers):
    stamp, publish, sequence = numbers

    def fill(writer):
        writer.write(1, 5, b'\0\1\0\0a', 5, 0)
        with pytest.raises(SignalError, match='expected nanoseconds'):
            writer.write(1, stamp, b'', publish, sequence)
        writer.flush()

    path = tmp_path / 'x.mcap'
    written(path, fill)
    assert len(read(path)) == 1


def test_a_full_disk_leaves_the_file_as_it_was(tmp_path, monkeypatch):
    writer = McapWriter(tmp_path / 'x.mcap', '')
    writer.add_topic(A)
    writer.write(1, 5, b'\0\1\0\0a', 5, 0)
    writer.flush()
    before = writer.path.read_bytes()

    class Full:
        """Takes ten bytes more."""

        def __init__(self, file):
            self.file, self.room = file, 10

        def fileno(self):
            return self.file.fileno()

        def write(self, data):
            if not self.room:
                raise OSError(28, 'No space left on device')
            taken = self.file.write(data[: self.room])
            self.room -= taken
            return taken

    writer.write(1, 6, b'\0\1\0\0b', 6, 0)
    with monkeypatch.context() as disk:
        disk.setattr(writer, '_file', Full(writer._file))  # noqa: SLF001 - the disk
        with pytest.raises(OSError, match='No space left'):
            writer.flush()
    assert writer.path.read_bytes() == before
    assert writer.waiting == 1
    writer.flush()  # now there is room
    writer.close({})
    assert [stamp for _, stamp, *_ in read(writer.path)] == [5, 6]
