"""Heads of many messages at a time: as they were written, or refused with the byte."""

from __future__ import annotations

from struct import pack

import numpy as np
import pytest

from agv_motion.bag.mcap.message_heads import HEAD, headed, heads

DATA = [b'abc', b'', b'0123456789']


def written():
    """Return three messages as they lie in a chunk, and where each begins."""
    rows = np.zeros(3, HEAD)
    rows['channel'], rows['sequence'] = (1, 2, 1), (7, 8, 9)
    rows['stamp'], rows['publish'] = (10, 20, 30), (11, 21, 31)
    parts, offsets = headed(rows, DATA)
    return b''.join(parts), offsets


def test_a_head_by_hand():
    """Opcode 5, length 22 + 3; channel, sequence, log and publish time; data: 31 bytes and data."""
    content, offsets = written()
    assert content[: HEAD.itemsize + 3] == pack('<BQHIQQ', 5, 25, 1, 7, 10, 11) + b'abc'
    assert offsets.tolist() == [0, 34, 65]


def test_what_was_written_is_read_in_any_order():
    content, offsets = written()
    found = heads(content, offsets[::-1])
    assert found['stamp'].tolist() == [30, 20, 10]
    assert found['publish'].tolist() == [31, 21, 11]
    assert found['channel'].tolist() == [1, 2, 1]
    assert found['sequence'].tolist() == [9, 8, 7]
    assert len(heads(content, offsets[:0])) == 0


def test_a_message_without_data_may_be_the_last_or_the_only_one():
    content, offsets = written()
    assert heads(content[:65], offsets[:2])['stamp'].tolist() == [10, 20]
    assert heads(content[34:65], offsets[:1])['stamp'].tolist() == [20]
    with pytest.raises(ValueError, match='a message at byte 0 of a content of 30'):
        heads(content[34:64], offsets[:1])


@pytest.mark.parametrize(
    ('cut', 'offsets', 'byte'),
    [
        (None, [1], 1),  # no message begins there
        (-1, [0, 65], 65),  # its data end too late
        (None, [65, 90], 90),  # no head has room there
        (20, [0], 0),
    ],
)
def test_no_whole_message_is_named_by_its_byte(cut, offsets, byte):
    with pytest.raises(ValueError, match=f'message at byte {byte} of '):
        heads(written()[0][:cut], np.array(offsets, np.uint64))


def test_a_length_beyond_all_files_is_no_message():
    content = bytearray(written()[0])
    content[1:9] = pack('<Q', 2**64 - 1)
    with pytest.raises(ValueError, match='no whole message at byte 0'):
        heads(bytes(content), np.array([0], np.uint64))
