"""One file through its chunks: spans, counts and entries by the indexes, or without them."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.channels import connections
from agv_motion.bag.mcap.chunked_file import ChunkedFile
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.mcap.mapped import mapped
from agv_motion.bag.mcap.scan import look
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic
from agv_motion.errors import SourceError

TOPICS = [Topic(name, 'a/msg/A', 'int8 x', '', ()) for name in ('/a', '/b')]


@pytest.fixture
def path(tmp_path):
    """Chunks of times 5 to 7 (two of /a, one of /b) and 10 (one of /b)."""
    writer = McapWriter(tmp_path / 'x.mcap', 'zstd')
    for topic in TOPICS:
        writer.add_topic(topic)
    for channel, stamp in ((1, 5), (2, 6), (1, 7)):
        writer.write(channel, stamp, b'\0\1\0\0%d' % stamp, stamp + 1, stamp)
    writer.flush()
    writer.write(2, 10, b'\0\1\0\0x', 10, 0)
    writer.flush()
    writer.close({})
    return writer.path


def opened(path, *, scan=False):
    data = mapped(path, path)
    found = look(data, path, believe=not scan)
    return ChunkedFile(path, data, found, connections(found))


@pytest.mark.parametrize('scan', [False, True])
def test_spans_counts_and_expectations(path, scan):
    file = opened(path, scan=scan)
    assert file.span == (5, 10)
    assert file.counts() == {1: 2, 2: 2}
    assert file.counted is not scan
    assert file.expected(0, 100) == {1: 2, 2: 2}
    assert file.expected(8, 100) == {2: 1}
    assert file.expected(0, 5) == {}
    assert file.expected(7, 8) == {1: 2, 2: 1}
    assert [c.topic for c in file.channels.values()] == ['/a', '/b']
    assert file.unpacked_size == 4 * (records.MESSAGE_HEAD.size + 5)
    file.close()


def test_entries_with_an_index_and_without_are_the_same(path):
    file = opened(path)
    chunk = file.chunks[0]
    for found in (file.entries(chunk), file.entries(chunk._replace(indexes=None))):
        assert found[1].stamps.tolist() == [5, 7]
        assert found[2].stamps.tolist() == [6]
    bare = chunk._replace(indexes=None)
    unpacked = file.content(chunk)
    for channel in (1, 2, 3):
        with_index, without = (
            file.index_of(each, channel, unpacked).tolist() for each in (chunk, bare)
        )
        assert with_index == without
    assert set(file.entries(chunk, wanted={2})) == {2} == set(file.entries(bare, wanted={2}))
    file.close()


def test_messages_at_their_places(path):
    file = opened(path)
    chunk = file.chunks[0]
    offsets = file.entries(chunk)[1].offsets.tolist()
    found = list(file.messages_at(file.content(chunk), offsets))
    assert [(m.connection.topic, m.stamp, m.publish, m.sequence) for m in found] == [
        ('/a', 5, 6, 5), ('/a', 7, 8, 7),
    ]  # fmt: skip
    assert [m.data for m in found] == [b'\0\1\0\0' + b'5', b'\0\1\0\0' + b'7']
    file.close()


def test_an_index_of_times_outside_its_chunk_is_damage(path):
    file = opened(path)
    narrow = file.chunks[0]._replace(end=6)
    with pytest.raises(DamagedBagError, match='times outside of its chunk at byte'):
        file.entries(narrow)
    file.close()


def test_it_is_told_with_the_place_of_the_index_that_is_wrong(tmp_path):
    """Of /b at 5 and 8; /a lies between, at 6."""
    writer = McapWriter(tmp_path / 'x.mcap', '')
    for topic in TOPICS:
        writer.add_topic(topic)
    for channel, stamp in ((1, 6), (2, 5), (2, 8)):
        writer.write(channel, stamp, b'\0\1\0\0x', stamp, 0)
    writer.flush()
    writer.close({})
    file = opened(writer.path)
    (chunk,) = file.chunks
    for narrow in (chunk._replace(start=6), chunk._replace(end=7)):
        with pytest.raises(DamagedBagError, match=f'its chunk at byte {chunk.offset}') as caught:
            file.entries(narrow)
        assert caught.value.offset == chunk.indexes[2]
    file.close()


def test_messages_that_nothing_describes_are_counted_too(path):
    file = opened(path, scan=True)
    file.channels = {2: file.channels[2]}
    assert file.counts() == {2: 2, 1: 2}
    file.close()


def test_a_channel_that_nothing_describes_is_damage(path):
    file = opened(path)
    chunk = file.chunks[0]
    unpacked = file.content(chunk)
    heads = file.heads(chunk, unpacked, file.entries(chunk)[1].offsets)
    file.require_described(chunk, heads)
    file.channels = {2: file.channels[2]}
    with pytest.raises(DamagedBagError, match='a message of channel 1, which is not described'):
        file.require_described(chunk, heads)
    file.close()


def test_the_content_is_kept_but_not_for_ever(path, monkeypatch):
    file = opened(path)
    first, second = file.chunks
    assert file.content(first) is file.content(first)
    monkeypatch.setattr('agv_motion.bag.mcap.chunk_cache.CACHE', 1)
    kept = file.content(first)
    file.content(second)
    assert file.content(first) is not kept
    assert bytes(file.content(first)) == bytes(kept)
    file.close()


def test_a_closed_file_says_so(path):
    file = opened(path)
    file.close()
    with pytest.raises(SourceError, match='was closed'):
        file.require_open()


def test_without_messages_there_is_no_span(tmp_path):
    writer = McapWriter(tmp_path / 'x.mcap', '')
    writer.close({})
    file = opened(writer.path)
    assert (file.span, file.counts(), file.problems) == (None, {}, [])
    file.close()


def in_memory(path):
    """Return how much of a file that is mapped lies in the memory of this process [bytes]."""
    maps = Path('/proc/self/smaps').read_text().split(str(path))[1:]
    return sum(int(one.partition('Rss:')[2].split()[0]) * 1024 for one in maps)


@pytest.mark.parametrize('compression', ['', 'zstd'])
@pytest.mark.parametrize('size', [1000, 300_000])
def test_what_was_read_of_a_file_stays_in_no_memory(tmp_path, compression, size):
    noise = np.random.default_rng(1).bytes(size)
    writer = McapWriter(tmp_path / 'large.mcap', compression)
    writer.add_topic(TOPICS[0])
    for stamp in range(6_000_000 // size):
        writer.write(1, stamp, noise, stamp, 0)
        if writer.chunk_size > 500_000:
            writer.flush()
    writer.flush()
    writer.close({})
    with closing(McapFile(writer.path)) as file:
        for read in (
            lambda: file.messages([1], 0, 2**64),
            lambda: (message for _, piece in file.pieces() for message in piece),
            file.damage,
        ):
            assert sum(1 for _ in read()) in (0, 6_000_000 // size)
            assert in_memory(writer.path) < 1_500_000
