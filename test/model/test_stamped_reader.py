"""What was learnt of a topic's names never changes what its next message is read as."""

from __future__ import annotations

from contextlib import suppress
from struct import pack

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.model.stamped_reader import StampedReader

NUMBERS = st.floats(allow_nan=False)
MESSAGES = st.tuples(
    st.sampled_from('<>'),
    st.integers(-(2**31), 2**31 - 1),
    st.integers(0, 999_999_999),
    st.lists(st.sampled_from(['', 'odom', 'oak/odom', 'Bäume', 'base_link']), max_size=3),
    st.lists(NUMBERS, max_size=4),
)


def joints():
    return StampedReader(lambda message: (message.texts(), message.count()))


def written(order, sec, nanosec, names, numbers):
    data = pack(f'{order}iII', sec, nanosec, len(names))
    for name in names:
        content = name.encode() + b'\0'
        data += bytes(-len(data) % 4) + pack(f'{order}I', len(content)) + content
    data += bytes(-len(data) % 4) + pack(f'{order}I', len(numbers))
    data += bytes(-len(data) % 8 if numbers else 0) + pack(f'{order}{len(numbers)}d', *numbers)
    return bytes((0, order == '<', 0, 0)) + data


@given(st.lists(MESSAGES, max_size=8))
def test_each_message_is_read_as_it_was_written_whatever_came_before(messages):
    reader = joints()
    for message in messages:
        _, sec, nanosec, names, numbers = message
        stamp, read, values = reader.read(written(*message))
        assert (stamp, read, [*values]) == (sec * 10**9 + nanosec, names, numbers)


def test_names_are_read_once_as_long_as_they_stay():
    asked = []
    reader = StampedReader(lambda message: (asked.append(1) or message.texts(), message.count()))
    for sec in range(3):
        reader.read(written('<', sec, 0, ['a'], [float(sec)]))
    assert len(asked) == 1
    for changed in (['b'], ['bc'], ['b', 'c']):
        assert reader.read(written('<', 0, 0, changed, [1.0]))[1] == changed
    assert len(asked) == 4


@given(MESSAGES, st.binary(max_size=80), st.integers(0, 100))
def test_what_is_no_message_is_refused_and_the_next_is_read_all_the_same(message, noise, length):
    reader, whole = joints(), written(*message)
    expected = reader.read(whole)
    with suppress(SignalError):
        reader.read(noise)
    if length < len(whole):
        with pytest.raises(SignalError, match=r'no message|ends in the midst'):
            reader.read(whole[:length])
    assert reader.read(whole) == expected


def test_more_numbers_than_there_are_cost_no_memory():
    with pytest.raises(SignalError, match='ends in the midst of its numbers'):
        joints().read(written('<', 0, 0, ['a'], [])[:-4] + b'\xff' * 4)


def test_a_stamp_behind_the_last_one_is_refused_by_name():
    reader = joints()
    assert reader.read(written('<', 2**31 - 1, 999_999_999, [], []))[0] == 2**31 * 10**9 - 1
    with pytest.raises(SignalError, match='2147483647 s and 4000000000 ns is behind'):
        reader.read(written('<', 2**31 - 1, 4_000_000_000, [], []))
