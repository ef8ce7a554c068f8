"""Chunks that are decoded together, by hand."""

from __future__ import annotations

from contextlib import closing

import numpy as np
import pytest

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import chunk_batches
from agv_motion.bag.mcap.chunk import Chunk
from agv_motion.bag.mcap.chunk_batches import batches, groups, unpacked
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic

SIZE = 31 + 5
"""[bytes] of a message with what stands before it"""


@pytest.fixture
def file(tmp_path):
    """Two chunks: /a at 5, /b at 6 and /a at 7; /b at 10."""
    writer = McapWriter(tmp_path / 'x.mcap', 'zstd')
    for name in ('/a', '/b'):
        writer.add_topic(Topic(name, 'a/msg/A', 'int8 x', '', ()))
    for entries in (((1, 5), (2, 6), (1, 7)), ((2, 10),)):
        for channel, stamp in entries:
            writer.write(channel, stamp, b'\0\1\0\0%c' % stamp, stamp, 0)
        writer.flush()
    writer.close({})
    with closing(McapFile(writer.path)) as opened:
        yield opened.as_chunks()


def test_chunks_go_together_as_long_as_they_have_room(monkeypatch):
    monkeypatch.setattr(chunk_batches, 'GROUP', 10)
    chunks = [Chunk(0, 0, 0, 0, size, None) for size in (4, 6, 1, 9, 20, 3)]
    assert [[c.size for c in group] for group in groups(chunks)] == [[4, 6], [1, 9], [20], [3]]
    assert list(groups([])) == []


def together(file, room=4 * SIZE):
    return unpacked(file, file.chunks, np.empty(room, np.uint8).data)


def test_messages_of_each_channel_where_they_lie_in_the_buffer(file):
    found = together(file)
    assert (len(found.data), found.ends.tolist()) == (4 * SIZE, [3 * SIZE, 4 * SIZE])
    one, other = batches(file, found, [1, 2], 0, 2**64)
    for batch, places, stamps in ((one, [0, 2], [5, 7]), (other, [1, 3], [6, 10])):
        assert batch.starts.tolist() == [SIZE * place + 35 for place in places]
        assert (batch.sizes.tolist(), batch.stamps.tolist()) == ([1, 1], stamps)
        assert bytes(np.asarray(batch.data)[batch.starts]) == bytes(stamps)
        assert batch.forms.tolist() == [1, 1]
        assert batch.origins == [(0, file.chunks[0].offset), (3 * SIZE, file.chunks[1].offset)]


@pytest.mark.parametrize(('span', 'stamps'), [
    ((0, 2**64), [5, 7]), ((5, 7), [5]), ((6, 8), [7]), ((0, 2**64 - 1), [5, 7]), ((8, 99), None),
])  # fmt: skip
def test_times_that_are_not_wanted_are_left_out(file, span, stamps):
    found = batches(file, together(file), [1], *span)
    assert [batch.stamps.tolist() for batch in found] == ([stamps] if stamps else [])


def test_a_chunk_that_has_no_room_in_the_buffer_is_by_itself_or_a_liar(file):
    alone = unpacked(file, file.chunks[:1], np.empty(3 * SIZE - 1, np.uint8).data)
    assert (len(alone.data), alone.ends.tolist()) == (3 * SIZE, [3 * SIZE])
    lying = [chunk._replace(size=SIZE - 1) for chunk in reversed(file.chunks)]
    with pytest.raises(
        DamagedBagError, match=rf'byte {lying[0].offset}: a chunk of 36 bytes, 35 by'
    ):
        unpacked(file, lying, np.empty(4 * SIZE, np.uint8).data)


def test_messages_that_are_not_where_the_index_says_are_damage_of_their_chunk(file):
    found = together(file)
    first, second = (chunk.offset for chunk in file.chunks)
    others = 'in this chunk, messages that are not those of the index of channel 2'
    for place, change, words in (
        (3 * SIZE + 9, 1, f'byte {second}: {others}'),  # its channel
        (3 * SIZE + 15, 9, f'byte {second}: {others}'),  # its time
        (SIZE + 9, 1, f'byte {first}: {others}'),
        (3 * SIZE, 9, f'byte {second}: in this chunk, no whole message at byte 0 of the content'),
        (SIZE, 9, f'byte {first}: in this chunk, no whole message at byte 36 of the content'),
    ):
        data = bytearray(found.data)
        data[place] = change
        with pytest.raises(DamagedBagError, match=words):
            batches(file, found._replace(data=data), [2], 0, 2**64)


@pytest.mark.parametrize(('index', 'damaged', 'words'), [
    ({(2, 0): [(6, 3 * SIZE)]}, 0, 'messages that are not those of the index of channel 2'),
    ({(2, 1): [(10, 0), (10, 9 * SIZE)]}, 1, 'a message at byte 324 of a content of 36'),
    ({(2, 1): [(10, 1)]}, 1, 'no whole message at byte 1 of the content'),
    ({(2, 1): [(10, 0)] * 4}, 1, 'messages that are not those of the index of channel 2'),
    ({(2, 0): [(6, SIZE)] * 4}, 0, 'messages that are not those of the index of channel 1'),
])  # fmt: skip
def test_the_chunk_is_named_whose_index_leads_astray(file, monkeypatch, index, damaged, words):
    """Also where it leads into the next chunk, and where it names a message many times."""
    truth = file.index_of

    def told(chunk, channel, content):
        changed = index.get((channel, file.chunks.index(chunk)))
        return truth(chunk, channel, content) if changed is None else np.array(changed, np.uint64)

    monkeypatch.setattr(file, 'index_of', told)
    where = f'byte {file.chunks[damaged].offset}: in this chunk, {words}'
    with pytest.raises(DamagedBagError, match=where):
        batches(file, together(file), [1, 2], 0, 2**64)
