"""The plan: which steps, in which order."""

from __future__ import annotations

import pytest

from agv_motion.bag import BagReader, BagWriter
from agv_motion.bag.connection import Message
from agv_motion.bag.editing.picking import Wanted
from agv_motion.bag.editing.steps import CHUNK, EditSource, ids_of, plan, stream, together
from agv_motion.errors import SignalError


@pytest.fixture
def sources(tmp_path):
    bags = []
    for name, stamps in (('one', (0, 10, 20)), ('two', (5, 15, 12))):
        with BagWriter(tmp_path / name, chunk_size=1) as bag:
            topic = bag.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
            for stamp in stamps:
                bag.write(topic, stamp, b'\0\1\0\0\1')
        bags.append(BagReader(tmp_path / name))
    yield [EditSource(bag.files[0], Wanted({1: 1}), packed=False) for bag in bags]
    for bag in bags:
        bag.close()


def stamps(steps):
    return [int(step.work().times[0]) for step in steps]


def test_chunks_of_several_files_take_turns_and_those_of_one_stay_in_their_order(sources):
    assert stamps(plan(sources)) == [0, 5, 10, 15, 12, 20]


def test_in_order_chunks_that_overlap_no_other_are_sorted_as_they_are(sources):
    assert stamps(plan(sources, ordered=True)) == [0, 5, 10, 12, 15, 20]


def test_a_stream_makes_chunks_of_about_a_mebibyte(sources):
    ids = ids_of(sources)
    (connection,) = ids
    messages = [Message(connection, i, bytes(CHUNK // 4), i, i) for i in range(10)]
    steps = list(stream(messages, ids))
    assert [step.start for step in steps] == [0, 4, 8]
    assert [len(step.work().stamps) for step in steps] == [4, 4, 2]


def test_a_time_that_no_file_can_hold_is_refused(sources):
    ids = ids_of(sources)
    one = Message(next(iter(ids)), 5, b'', 5, 0)
    for wrong, what in (
        (one._replace(stamp=-1), 'log times from -1 to 5'),
        (one._replace(stamp=2**64), f'log times from 5 to {2**64}'),
        (one._replace(publish=2**64), f'publish times from 5 to {2**64}'),
    ):
        with pytest.raises(SignalError, match=f'^{what}: expected nanoseconds'):
            together([one, wrong, one], ids)
    limits = [one._replace(stamp=0, publish=0), one._replace(stamp=2**64 - 1, publish=2**64 - 1)]
    assert together(limits, ids).stamps.tolist() == [0, 2**64 - 1]


def test_each_step_tells_what_it_needs(sources):
    """A chunk as it is stored and unpacked; messages with 31 bytes before each, and once more."""
    first = next(iter(plan(sources)))
    chunk = sources[0].file.chunks[0]
    assert (first.start, first.size, first.read) == (0, chunk.size + chunk.length, chunk.length)
    ids = ids_of(sources)
    messages = [Message(next(iter(ids)), i, bytes(9), i, i) for i in (7, 8, 9)]
    (step,) = stream(messages, ids)
    assert (step.start, step.size, step.read) == (7, 240, 120)
    assert step.work().offsets.tolist() == [0, 40, 80]


def test_chunks_that_overlap_are_merged_to_the_last_message_of_theirs(tmp_path):
    """From 0 to 20, 15 to 30 and 30 to 40 they touch; from 41 on one stands alone."""
    spans = ((0, 20), (15, 30), (30, 40), (41, 50))
    with BagWriter(tmp_path / 'one', chunk_size=1 << 20, chunk_duration=1e9) as bag:
        topic = bag.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
        for span in spans:
            for stamp in span:
                bag.write(topic, stamp, b'\0\1\0\0\1')
            bag.flush()
    with BagReader(tmp_path / 'one') as bag:
        assert [(c.start, c.end) for c in bag.files[0].chunks] == list(spans)
        source = EditSource(bag.files[0], Wanted({1: 1}), packed=False)
        merged, alone = (step.work() for step in plan([source], ordered=True))
        assert merged.stamps.tolist() == [0, 15, 20, 30, 30, 40]
        assert (alone.fresh, alone.times) == (False, (41, 50))
        some = source._replace(wanted=Wanted({1: 1}, ((0, 16), (30, 42))))
        merged, alone = (step.work() for step in plan([some], ordered=True))
        assert (merged.stamps.tolist(), alone.stamps.tolist()) == ([0, 15, 30, 30, 40], [41])
