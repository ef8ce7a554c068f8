"""A walk through a file finds what its summary says, and more where that is missing or lies."""

from __future__ import annotations

import pytest

from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.chunk_content import content, message_offsets
from agv_motion.bag.mcap.record_parsing import Body, chunk_head, walk
from agv_motion.bag.mcap.scan import look, scan
from agv_motion.bag.mcap.summary import read
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic

TOPICS = [Topic(name, 'a/msg/A', 'int8 x', '', ()) for name in ('/a', '/b')]


@pytest.fixture
def file(tmp_path):
    """Three chunks of two messages, at 0 and 1, 10 and 11, 20 and 21."""
    writer = McapWriter(tmp_path / 'x.mcap', '')
    for topic in TOPICS:
        writer.add_topic(topic)
    for k in (0, 10, 20):
        writer.write(1, k, b'\0\1\0\0\1', k, 0)
        writer.write(2, k + 1, b'\0\1\0\0\2', k + 1, 0)
        writer.flush()
    writer.close({})
    return writer.path


def places(data, opcode):
    return [at for kind, at, _ in walk(data, len(records.MAGIC), len(data)) if kind == opcode]


def stamps(chunks):
    return [(chunk.start, chunk.end) for chunk in chunks]


def test_a_walk_finds_what_the_summary_says(file):
    data = memoryview(file.read_bytes())
    found, told = scan(data, file), read(data, file)
    assert not found.indexed
    assert found.problems == []
    assert found.schemas == told.schemas
    assert found.channels == told.channels
    assert stamps(found.chunks) == stamps(told.chunks) == [(0, 1), (10, 11), (20, 21)]
    assert [c.indexes for c in found.chunks] == [c.indexes for c in told.chunks]


def test_a_torn_file_gives_its_whole_chunks_and_what_is_left_of_the_last(file):
    data = file.read_bytes()
    last = places(data, records.CHUNK)[2] - records.PREFIX.size
    torn = memoryview(data[: last + 70])
    found = look(torn, file)
    assert stamps(found.chunks) == [(0, 1), (10, 11), (20, 21)]
    assert [chunk.torn for chunk in found.chunks] == [False, False, True]
    assert 'the file ends here' in str(found.problems[0])
    saved = content(torn, found.chunks[2], file, validate=True)
    assert len(message_offsets(saved)) <= 1


def test_indexes_before_the_tear_may_be_too_few(file):
    """The chunk is whole, one of its two indexes is gone: it is walked through."""
    data = file.read_bytes()
    second = places(data, records.MESSAGE_INDEX)[5]
    found = scan(memoryview(data[: second + 3]), file)
    assert found.chunks[2].indexes is None
    assert found.chunks[1].indexes is not None
    assert stamps(found.chunks)[2] == (20, 21)


def test_statistics_that_tell_another_number_are_not_believed(file):
    data = memoryview(file.read_bytes())
    told = read(data, file).statistics._replace(messages=7)
    found = scan(data, file, told)
    assert 'statistics of 7 messages, where 6 are found' in str(found.problems[-1])
    assert all(chunk.indexes is None for chunk in found.chunks)


def test_messages_outside_chunks_are_stretches(file, tmp_path):
    """Two in a row make one; after a chunk begins another."""
    data = file.read_bytes()
    first, second, *_ = (at - records.PREFIX.size for at in places(data, records.CHUNK))
    bare = [
        records.MESSAGE_HEAD.pack(records.MESSAGE, 22 + 5, 1, 0, stamp, stamp) + b'\0\1\0\0\3'
        for stamp in (7, 5, 9)
    ]
    changed = data[:first] + bare[0] + bare[1] + data[first:second] + bare[2]
    found = scan(memoryview(changed + records.data_end()), file)
    assert [chunk.bare for chunk in found.chunks] == [True, False, True]
    assert stamps(found.chunks) == [(5, 7), (0, 1), (9, 9)]
    assert found.problems == []


def test_stretches_end_where_they_are_long_or_where_something_else_lies(tmp_path, monkeypatch):
    """Of 36 bytes each: two are longer than 50; a record between begins another, too."""
    monkeypatch.setattr('agv_motion.bag.mcap.scan.STRETCH', 50)
    message = [
        records.MESSAGE_HEAD.pack(records.MESSAGE, 22 + 5, 1, 0, stamp, stamp) + b'\0\1\0\0\3'
        for stamp in range(5)
    ]
    other = records.metadata(records.Metadata('a', {}))
    channel = records.channel(records.Channel(1, 0, '/a', 'cdr', {}))
    parts = [records.MAGIC, channel, *message[:4], other, message[4], records.data_end()]
    found = scan(memoryview(b''.join(parts)), tmp_path / 'x.mcap')
    begin = len(records.MAGIC) + len(channel)
    assert [(c.offset - begin, c.length, c.size) for c in found.chunks] == [
        (0, 72, 72), (72, 72, 72), (144 + len(other), 36, 36),
    ]  # fmt: skip
    assert stamps(found.chunks) == [(0, 1), (2, 3), (4, 4)]
    assert found.problems == []


def test_an_end_of_data_that_is_too_short_for_a_crc_has_none(file):
    data = file.read_bytes()
    first = places(data, records.CHUNK)[0] - records.PREFIX.size
    message = records.MESSAGE_HEAD.pack(records.MESSAGE, 22 + 5, 1, 0, 7, 7) + b'\0\1\0\0\3'
    end = records.PREFIX.pack(records.DATA_END, 3) + bytes(3)
    assert scan(memoryview(data[:first] + message + end), file).problems == []


def test_a_wrong_byte_among_messages_outside_chunks_is_told_by_the_crc_of_the_data(file):
    data = file.read_bytes()
    first = places(data, records.CHUNK)[0] - records.PREFIX.size
    message = records.MESSAGE_HEAD.pack(records.MESSAGE, 22 + 5, 1, 0, 7, 7) + b'\0\1\0\0\3'
    before = data[:first] + message
    for crc, fine in ((records.crc32(before), True), (0, True), (1, False)):
        found = scan(memoryview(before + records.data_end(crc)), file)
        assert (found.problems == []) == fine
    assert 'expected 00000001: one of them is wrong' in str(found.problems[0])


def test_channels_that_are_described_inside_of_a_chunk_only_are_found(tmp_path):
    inside = (
        records.schema(records.Schema(4, 'a/msg/A', 'ros2msg', b'int8 x'))
        + records.channel(records.Channel(9, 4, '/inside', 'cdr', {}))
        + records.MESSAGE_HEAD.pack(records.MESSAGE, 22 + 5, 9, 0, 7, 7) + b'\0\1\0\0\3'
    )  # fmt: skip
    head = records.chunk_head((7, 7), (len(inside), len(inside)), 0, '')
    data = records.MAGIC + records.header('ros2', 'us') + head + inside + records.data_end()
    found = scan(memoryview(data), tmp_path / 'x.mcap')
    assert found.channels[9].topic == '/inside'
    assert found.schemas[4].name == 'a/msg/A'
    assert found.problems == []


@pytest.mark.parametrize('lost', [{records.MESSAGE_INDEX}, set()])
@pytest.mark.parametrize('chunked', [True, False])
def test_messages_of_a_channel_that_nothing_describes_are_told(file, lost, chunked):
    """Readers ask for topics: without a problem such messages would be gone in silence."""
    whole, kept = file.read_bytes(), [records.MAGIC]
    for opcode, at, end in walk(whole, len(records.MAGIC), len(whole)):
        record = whole[at - records.PREFIX.size : end]
        if opcode == records.CHUNK and not chunked:
            head = chunk_head(Body(whole[at:end], file, at), at)
            record = whole[head.content : end]
        second = opcode == records.CHANNEL and whole[at : at + 2] == b'\2\0'
        if not second and opcode not in lost:
            kept.append(record)
        if opcode == records.DATA_END:
            break
    found = look(memoryview(b''.join(kept)), file)
    assert list(found.channels) == [1]
    assert 'messages of channel 2, which is not described' in str(found.problems[0])
