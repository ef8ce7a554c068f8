"""An MCAP file in batches: only what is wanted is unpacked, and not much of it at once."""

from __future__ import annotations

from contextlib import closing

import pytest

from agv_motion.bag.mcap import batches, chunk_batches
from agv_motion.bag.mcap.file import McapFile
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic


@pytest.fixture
def file(tmp_path):
    """Chunks at 0 to 3 and at 10 of /a, at 20 of /b, at 30 to 33 of /a, at 40 of both."""
    writer = McapWriter(tmp_path / 'x.mcap', '')
    for name in ('/a', '/b'):
        writer.add_topic(Topic(name, 'a/msg/A', 'int8 x', '', ()))
    for entries in (
        ((1, 0), (1, 3)),
        ((1, 10),),
        ((2, 20),),
        ((1, 30), (1, 33)),
        ((1, 40), (2, 40)),
    ):
        for channel, stamp in entries:
            writer.write(channel, stamp, b'\0\1\0\0%c' % stamp, stamp, 0)
        writer.flush()
    writer.close({})
    with closing(McapFile(writer.path)) as opened:
        yield opened.as_chunks()


@pytest.mark.parametrize(('wanted', 'unpacked', 'stamps'), [
    (([1, 2], 0, 2**64), [0, 10, 20, 30, 40], [0, 3, 10, 20, 30, 33, 40, 40]),
    (([2], 0, 2**64), [20, 40], [20, 40]), (([1], 10, 33), [10, 30], [10, 30]),
    (([1], 3, 10), [0], [3]), (([1], 4, 10), [], []), (([2], 0, 20), [], []), (([], 0, 99), [], []),
])  # fmt: skip
def test_only_chunks_that_may_have_what_is_wanted_are_unpacked(
    file, monkeypatch, wanted, unpacked, stamps
):
    seen, found, unpack = [], [], file.unpacked

    def unpacking(chunk, target=None):
        seen.append(chunk.start)
        return unpack(chunk, target)

    monkeypatch.setattr(file, 'unpacked', unpacking)
    batches.read_mcap(file, *wanted, lambda batch: found.extend(batch.stamps.tolist()))
    assert sorted(seen) == unpacked
    assert sorted(found) == stamps


def test_no_more_chunks_wait_than_there_are_threads_and_one(file, monkeypatch):
    """A pool that works only when it is asked for a result: what waits is counted."""
    waiting, most = [], []

    class Later:
        def __init__(self, work, *given):
            self.result = lambda: (waiting.remove(self), work(*given))
            waiting.append(self)
            most.append(len(waiting))

    class Pool:
        def __init__(self, size):
            assert size == 2

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        submit = Later

    monkeypatch.setattr(batches, 'threads', lambda: 2)
    monkeypatch.setattr(batches, 'ThreadPoolExecutor', Pool)
    monkeypatch.setattr(chunk_batches, 'GROUP', 1)
    found = []
    batches.read_mcap(file, [1, 2], 0, 2**64, lambda batch: found.extend(batch.stamps.tolist()))
    assert found == [0, 3, 10, 20, 30, 33, 40, 40]
    assert most == [1, 2, 3, 3, 3]
    assert waiting == []
