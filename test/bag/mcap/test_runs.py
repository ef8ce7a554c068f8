"""Chunks that are read together, and what their indexes tell against what lies in them."""

from __future__ import annotations

import itertools
from struct import pack_into

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag import BagReader, BagWriter, DamagedBagError
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.chunk import Chunk
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.mcap.runs import successive

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
