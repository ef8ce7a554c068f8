"""Messages of two bags find each other by header, by time of arrival, or by place."""

from __future__ import annotations

from struct import pack
from types import SimpleNamespace as Some

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag.editing.pairing import Pairing, pairs
from agv_motion.errors import SourceError

HEADED = 'std_msgs/Header header\nfloat64 x'
PLAIN = 'float64 x'
SECOND = 10**9


def message(stamp, arrived=0, *, definition=HEADED, order='<', data=None):
    form = b'\0\1\0\0' if order == '<' else b'\0\0\0\0'
    seconds, rest = divmod(stamp, SECOND)
    whole = form + pack(f'{order}iI', seconds, rest) if data is None else data
    connection = Some(definition=definition, topic='/a', type='x/msg/Y')
    return Some(stamp=arrived, data=whole, connection=connection, told=stamp)


def paired(first, second, pairing):
    return [
        (one and one.told, other and other.told)
        for one, other in pairs(
            [message(t, t) for t in first], [message(t, t) for t in second], pairing
        )
    ]


def test_those_of_the_same_stamp_belong_together_whatever_the_byte_order():
    assert paired([1, 2, 4], [2, 3, 4], Pairing()) == [(1, None), (2, 2), (None, 3), (4, 4)]
    (pair,) = pairs([message(7 * SECOND + 5)], [message(7 * SECOND + 5, order='>')], Pairing())
    assert None not in pair


def test_the_nearest_belong_together_within_a_time():
    near = Pairing(within=3)
    assert paired([10, 20], [12, 24], near) == [(10, 12), (20, None), (None, 24)]
    assert paired([10, 11], [12], near) == [(10, None), (11, 12)]
    assert paired([12], [10, 11], near) == [(None, 10), (12, 11)]
    assert paired([10], [13], near) == [(10, 13)]
    assert paired([10], [14], near) == [(10, None), (None, 14)]


def test_the_nth_belongs_to_the_nth_by_place_and_without_a_header():
    assert paired([5, 6, 7], [1, 2], Pairing(by_place=True)) == [(5, 1), (6, 2), (7, None)]
    plain = [[message(0, t, definition=PLAIN) for t in times] for times in ((1, 9), (2, 3))]
    assert all(None not in pair for pair in pairs(*plain, Pairing()))
    found = [(a and a.stamp, b and b.stamp) for a, b in pairs(*plain, Pairing(within=1))]
    assert found == [(1, 2), (None, 3), (9, None)]


TIMES = st.lists(st.integers(0, 60), max_size=12).map(sorted)


@given(TIMES, TIMES, st.sampled_from([None, 0, 2, 10]), st.booleans())
def test_each_is_told_exactly_once_and_no_pair_is_further_apart(first, second, within, by_place):
    found = paired(first, second, Pairing(by_place, within))
    assert [a for a, _ in found if a is not None] == first
    assert [b for _, b in found if b is not None] == second
    if not by_place:
        both = [abs(a - b) for a, b in found if None not in (a, b)]
        assert max(both, default=0) <= (within or 0)


@pytest.mark.parametrize(
    ('pairing', 'tolerance'),
    [(Pairing(), 0), (Pairing(within=5), 5), (Pairing(by_place=True), None),
     (Pairing(by_place=True, within=5), 5)],
)  # fmt: skip
def test_times_in_a_pair_may_differ_by_what_was_asked(pairing, tolerance):
    assert pairing.tolerance == tolerance


@pytest.mark.parametrize('data', [b'', b'\0\1\0\0', b'\0\1\0\0' + bytes(7)])
def test_a_message_too_short_for_its_header_is_told(data):
    with pytest.raises(SourceError, match=f'{len(data)} bytes, too few for the header of x/msg/Y'):
        list(pairs([message(0, 3, data=data)], [message(0)], Pairing()))
