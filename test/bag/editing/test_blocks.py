"""Messages in blocks, read ahead."""

from __future__ import annotations

import threading

import pytest

from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.editing import blocks as module
from agv_motion.bag.editing.blocks import blocks_ahead
from agv_motion.bag.mcap.records import MESSAGE_HEAD

TOPIC = Connection('/a', 'a/msg/A', '', '', 'cdr', '', ())


def message(stamp, size=69):
    return Message(TOPIC, stamp, bytes(size), stamp, 0)


@pytest.mark.parametrize('size', [1, 100, 101, 250, 10_000])
def test_all_messages_come_in_their_order_in_blocks_that_are_just_full(size):
    given = [message(stamp) for stamp in range(10)]
    found = list(blocks_ahead(iter(given), size))
    assert [one for block in found for one in block] == given
    each = 69 + MESSAGE_HEAD.size
    for block in found[:-1]:
        assert each * (len(block) - 1) < size <= each * len(block)


def test_nothing_is_no_block_and_small_messages_fill_one_by_their_number(monkeypatch):
    assert list(blocks_ahead(iter([]), 5)) == []
    monkeypatch.setattr(module, 'MOST', 3)
    found = blocks_ahead((message(stamp) for stamp in range(7)), 1 << 20)
    assert [len(block) for block in found] == [3, 3, 1]


def test_the_next_block_is_read_while_one_is_used_and_an_error_comes_in_its_turn():
    read_on = threading.Event()

    def messages():
        yield message(0)
        yield message(1)
        read_on.set()
        msg = 'damaged'
        raise ValueError(msg)

    found = blocks_ahead(messages(), 1)
    assert next(found) == [message(0)]
    assert next(found) == [message(1)]
    assert read_on.wait(30)
    with pytest.raises(ValueError, match='damaged'):
        next(found)
