"""Chunks that are read together, and what their indexes tell against what lies in them."""

from __future__ import annotations

import itertools
from contextlib import closing
from struct import pack_into

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag import BagReader, BagWriter, DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.chunk import Chunk
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.mcap.runs import runs, successive
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic

TEXT = 'std_msgs/msg/String'
spans = st.lists(st.tuples(st.integers(0, 50), st.integers(0, 10)), max_size=20)


def chunk(place, start, end, size=100):
    return Chunk(place, size, start, end, size, {1: 0})


@given(spans)
def test_groups_hold_every_chunk_once_and_overlap_no_other_group_of_several(found):
    chunks = [chunk(i, start, start + length) for i, (start, length) in enumerate(found)]
    groups = list(successive(chunks))
    assert [c for group in groups for c in group] == sorted(chunks, key=lambda c: c.start)
    for group in groups:
        for before, after in itertools.pairwise(group):
            assert before.end <= after.start
            assert before.offset < after.offset


@pytest.mark.parametrize(('given', 'groups'), [
    ([(0, 0, 4), (1, 1, 6), (2, 2, 1), (3, 3, 9), (4, 4, 1)], [2, 2, 1]),  # at most 10 bytes
    ([(0, 0, 1), (0, 0, 1)], [2]), ([(0, 1, 1), (1, 2, 1)], [2]), ([(0, 2, 1), (1, 3, 1)], [1, 1]),
    ([(0, 2, 1), (1, 3, 1), (3, 4, 1)], [1, 2]), ([(0, 2, 1), (1, 3, 1), (2, 4, 1)], [1, 1, 1]),
    ([(0, 5, 1), (1, 2, 1), (3, 4, 1), (5, 6, 1), (6, 7, 1)], [1, 1, 1, 2]),
    ([(0, 5, 1), (1, 6, 1), (6, 7, 1), (7, 8, 1)], [1, 3]),
])  # fmt: skip
def test_which_chunks_go_together_by_hand(monkeypatch, given, groups):
    """Those that begin when the one before has ended, and after all of the groups before."""
    monkeypatch.setattr('agv_motion.bag.mcap.runs._LARGEST', 10)
    chunks = [chunk(i, start, end, size) for i, (start, end, size) in enumerate(given)]
    assert [len(group) for group in successive(chunks)] == groups
    assert [c for group in successive(chunks) for c in group] == chunks


def test_only_runs_that_may_have_what_is_wanted_are_there(tmp_path):
    """Chunks at 5 to 7 of both channels, and at 10 of the second."""
    writer = McapWriter(tmp_path / 'x.mcap', '')
    for name in ('/a', '/b'):
        writer.add_topic(Topic(name, 'a/msg/A', 'int8 x', '', ()))
    for entries in (((1, 5), (2, 6), (1, 7)), ((2, 10),)):
        for number, stamp in entries:
            writer.write(number, stamp, b'\0\1\0\0x', stamp, 0)
        writer.flush()
    writer.close({})
    with closing(McapFile(writer.path)) as file:
        first, second = ((c.start, c.offset) for c in file.chunks)
        for wanted, span, expected in (
            ((1, 2), (0, 99), [first]), ((1,), (0, 99), [first]), ((2,), (8, 99), [second]),
            ((2,), (7, 10), [first]), ((1, 2), (0, 5), []), ((1,), (8, 99), []),
            ((3,), (0, 99), []),
        ):  # fmt: skip
            found = list(runs(file, frozenset(wanted), range(*span)))
            assert [run[:2] for run in found] == expected
        ((_, _, opened),) = runs(file, frozenset((2,)), range(99))
        assert opened().stamps == [6, 10]


def test_large_chunks_are_read_alone():
    chunks = [chunk(i, 10 * i, 10 * i + 5, 600_000) for i in range(3)]
    assert list(successive(chunks)) == [[c] for c in chunks]


@pytest.fixture
def bag(tmp_path):
    """Three small chunks of one message each, not compressed."""
    with BagWriter(tmp_path / 'bag', compression='none', chunk_size=1) as writer:
        topic = writer.add_topic('/a', TEXT, 'string data')
        for i in range(3):
            writer.write(topic, 10 + i, b'\0\1\0\0\2\0\0\0%d\0' % i)
    return tmp_path / 'bag' / 'bag_0.mcap'


def test_small_chunks_that_follow_each_other_are_read_in_order(bag):
    with BagReader(bag) as reader:
        assert [message.data[8:9] for message in reader.messages()] == [b'0', b'1', b'2']


@pytest.mark.parametrize('offset', [1, 60, 2**32, 2**63, 2**64 - 1, 2**64 - 40, 2**64 - 80])
def test_an_offset_that_points_elsewhere_yields_no_message_of_another_chunk(bag, offset):
    file = McapFile(bag)
    at = file.chunks[1].indexes[1]
    file.close()
    data = bytearray(bag.read_bytes())
    pack_into('<Q', data, at + records.PREFIX.size + 2 + 4 + 8, offset)
    bag.write_bytes(data)
    with BagReader(bag) as reader:
        found = reader.messages()
        assert next(found).data[8:9] == b'0'
        with pytest.raises(DamagedBagError, match='in this chunk'):
            next(found)
