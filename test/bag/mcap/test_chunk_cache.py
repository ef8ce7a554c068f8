"""Contents are kept up to a size, the newest first."""

from __future__ import annotations

from agv_motion.bag.mcap import chunk_cache
from agv_motion.bag.mcap.chunk import Chunk
from agv_motion.bag.mcap.chunk_cache import ChunkCache


def test_a_content_is_unpacked_once_until_others_take_its_room(monkeypatch):
    monkeypatch.setattr(chunk_cache, 'CACHE', 10)
    made = []

    def unpack(chunk):
        made.append(chunk.offset)
        return bytes(chunk.size)

    cache = ChunkCache()
    first, second, large = (Chunk(n, 0, 0, 0, size, {}) for n, size in ((0, 4), (1, 6), (2, 11)))
    for chunk in (first, second, first, second):
        assert len(cache.content(chunk, unpack)) == chunk.size
    assert made == [0, 1]
    cache.content(large, unpack)
    cache.content(large, unpack)
    assert made == [0, 1, 2]
    cache.content(first, unpack)
    assert made == [0, 1, 2, 0]
    cache.forget(first)
    cache.forget(first)
    cache.content(first, unpack)
    assert made == [0, 1, 2, 0, 0]
    cache.clear()
    cache.content(first, unpack)
    assert made == [0, 1, 2, 0, 0, 0]
