"""What is taken of one chunk."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag import BagReader, BagWriter
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.editing.picking import Picked, Wanted, joined, pick
from agv_motion.bag.mcap.output import NewChunk


@pytest.fixture(scope='module')
def file(tmp_path_factory):
    folder = tmp_path_factory.mktemp('bags') / 'bag'
    with BagWriter(folder, compression='none') as bag:
        a, b = (bag.add_topic(n, 'a/msg/A', 'int8 data', type_hash='') for n in ('/a', '/b'))
        for i in (0, 1, 3, 2, 4, 5):
            bag.write((a, b)[i % 2], i, b'\0\1\0\0' + bytes((i,)))
    with BagReader(folder) as reader:
        yield reader.files[0]


def picked(file, **wanted):
    return pick(file, file.chunks[0], Wanted(**wanted))


SAME = {1: 1, 2: 2}


def test_all_is_the_chunk_as_it_is_stored(file):
    chunk = picked(file, channels=SAME)
    assert isinstance(chunk, NewChunk)
    assert (chunk.fresh, chunk.times, chunk.messages) == (False, (0, 5), 6)
    assert bytes(chunk.stored) == bytes(file.content(file.chunks[0]))
    assert set(chunk.indexes) == {1, 2}


@pytest.mark.parametrize(('wanted', 'stamps', 'channels'), [
    ({'channels': {1: 1}}, [0, 2, 4], [1, 1, 1]),
    ({'channels': {1: 300, 2: 2}}, [0, 1, 3, 2, 4, 5], [300, 2, 2, 300, 300, 2]),
    ({'channels': {1: 2, 2: 1}}, [0, 1, 3, 2, 4, 5], [2, 1, 1, 2, 2, 1]),
    ({'channels': SAME, 'spans': ((1, 3), (5, 9))}, [1, 2, 5], [2, 1, 2]),
    ({'channels': SAME, 'ordered': True}, [0, 1, 2, 3, 4, 5], [1, 2, 1, 2, 1, 2]),
    ({'channels': SAME, 'compression': 'zstd'}, [0, 1, 3, 2, 4, 5], [1, 2, 2, 1, 1, 2]),
])  # fmt: skip
def test_messages_are_gathered_with_their_new_ids(file, wanted, stamps, channels):
    found = picked(file, **wanted)
    assert isinstance(found, Picked)
    assert found.stamps.tolist() == stamps
    assert found.channels.tolist() == channels
    for stamp, channel, offset in zip(stamps, channels, found.offsets.tolist(), strict=True):
        message = found.content[offset : offset + 36]
        assert int.from_bytes(message[9:11], 'little') == channel
        assert message[-1] == stamp


def test_nothing_wanted_is_nothing(file):
    assert picked(file, channels={7: 7}) is None
    assert picked(file, channels=SAME, spans=((6, 9),)) is None
    assert not Wanted({7: 7}).overlaps(file.chunks[0])
    assert not Wanted(SAME, ((6, 9),)).overlaps(file.chunks[0])
    assert Wanted(SAME, ((6, 9), (5, 6))).overlaps(file.chunks[0])


def test_parts_are_joined_and_packed_with_an_index_of_each_channel(file):
    one, two = (picked(file, channels={n: n}) for n in (1, 2))
    whole = joined([one, two])
    assert whole.offsets.tolist() == [0, 36, 72, 108, 144, 180]
    chunk = whole.packed('lz4')
    assert (chunk.fresh, chunk.compression, chunk.times, chunk.size) == (True, 'lz4', (0, 5), 216)
    entries = {n: np.frombuffer(e, '<u8').reshape(-1, 2).tolist() for n, e in chunk.indexes.items()}
    assert entries == {1: [[0, 0], [2, 36], [4, 72]], 2: [[1, 108], [3, 144], [5, 180]]}
    assert joined([one]) is one


@pytest.mark.parametrize('change', [{'start': 1}, {'end': 4}])
def test_messages_outside_of_the_time_of_their_chunk_are_damage(file, change):
    chunk = file.chunks[0]._replace(**change)
    words = f'in this chunk, messages outside of its time, {chunk.start} to {chunk.end} ns'
    with pytest.raises(DamagedBagError, match=f'byte {chunk.offset}: {words}'):
        pick(file, chunk, Wanted(SAME))


@pytest.mark.parametrize('row', [0, 1, 2])
def test_a_message_that_no_index_tells_of_is_damage(file, monkeypatch, row):
    """At the beginning of the chunk, between others, and behind them."""
    truth = file.index_of
    monkeypatch.setattr(file, 'index_of', lambda *asked: np.delete(truth(*asked), row, axis=0))
    with pytest.raises(DamagedBagError, match='messages that its index does not tell of'):
        picked(file, channels=SAME)


TYPE, CHANNEL = (bytes((opcode,)) + (2).to_bytes(8, 'little') + b'\2\0' for opcode in (3, 4))
"""Descriptions as short as they can be, of type 2 and channel 2"""


@pytest.mark.parametrize(('more', 'finding'), [
    (b'\3', 'a record without end at byte 216 of its content'),
    (TYPE[:-1], 'a record without end at byte 216 of its content'),
    (TYPE + b'\4', 'a record without end at byte 227 of its content'),
])  # fmt: skip
def test_what_is_no_record_behind_the_messages_is_damage(file, monkeypatch, more, finding):
    content = bytes(file.content(file.chunks[0])) + more
    monkeypatch.setattr(file, 'unpacked', lambda _: content)
    with pytest.raises(DamagedBagError, match=f'in this chunk, {finding}'):
        picked(file, channels=SAME)


@pytest.mark.parametrize(('more', 'foreign', 'copied'), [
    (TYPE, (), True), (CHANNEL, (), True), (TYPE + CHANNEL, (), True), (b'', (1, 2), True),
    (TYPE, (1,), False), (CHANNEL, (1,), True), (CHANNEL, (2,), False),
    (CHANNEL[:-2] + b'\3\0', (), False), (CHANNEL[:1] + bytes(8), (2,), True),
])  # fmt: skip
def test_a_chunk_with_descriptions_is_copied_where_they_hold(
    file, monkeypatch, more, foreign, copied
):
    content = bytes(file.content(file.chunks[0])) + more
    monkeypatch.setattr(file, 'unpacked', lambda _: content)
    found = picked(file, channels=SAME, foreign=frozenset(foreign))
    assert isinstance(found, NewChunk if copied else Picked)
    if not copied:
        assert found.content == content[:216]


def test_a_chunk_without_an_index_gets_one(file):
    """It is copied as it lies there; so is one whose compression is asked for by name."""
    chunk = file.chunks[0]
    indexed, bare = (pick(file, one, Wanted(SAME)) for one in (chunk, chunk._replace(indexes=None)))
    assert bare.fresh is False
    assert bare.indexes == {n: bytes(table) for n, table in indexed.indexes.items()}
    assert pick(file, chunk, Wanted(SAME, compression='')).fresh is False
