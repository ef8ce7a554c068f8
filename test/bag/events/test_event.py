"""Events as values: joined, named, written down, read again."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.bag.events.event import (
    MOST_MOMENTS,
    Moment,
    from_entries,
    new_event,
)
from agv_motion.bag.events.event_parameters import EventParameters

SECOND = 10**9
GIVEN = EventParameters(before=10.0, after=5.0, longest_event=30.0)


@given(st.lists(st.integers(0, 100), min_size=1, max_size=40))
def test_an_event_covers_before_and_after_each_of_its_moments_until_it_is_longest(seconds):
    first, *rest = sorted(seconds)
    event = new_event(Moment(first * SECOND, 'a'), GIVEN)
    for second in rest:
        moment = Moment(second * SECOND, 'b')
        if event.takes(moment):
            event = event.joined(moment, GIVEN)
            wanted = min(second + 5, first + 30) * SECOND
            assert event.end >= wanted
    assert event.begin == max(first - 10, 0) * SECOND
    assert event.end <= (first + 30) * SECOND


def test_of_many_moments_the_number_is_told():
    event = new_event(Moment(0, 'a'), GIVEN)
    for i in range(MOST_MOMENTS + 5):
        event = event.joined(Moment(i, 'b'), GIVEN)
    assert (len(event.moments), event.more) == (MOST_MOMENTS, 6)


@pytest.mark.parametrize(('reason', 'name'), [
    ('/state ~ stopped', 'event_1970_01_01-00_00_05Z_state_stopped'),
    ('../../etc/passwd', 'event_1970_01_01-00_00_05Z_etc_passwd'),
    ('§', 'event_1970_01_01-00_00_05Z_marked'),
    ('x' * 500, 'event_1970_01_01-00_00_05Z_' + 'x' * 60),
])  # fmt: skip
def test_the_name_tells_when_and_why(reason, name):
    assert new_event(Moment(5 * SECOND, reason), GIVEN).folder_name() == name


def test_it_is_read_as_it_was_written():
    event = new_event(Moment(5 * SECOND, 'a'), GIVEN).joined(Moment(6 * SECOND, 'b'), GIVEN)
    assert from_entries(event.entries()) == event


@pytest.mark.parametrize('entries', [
    None, {}, [], {'moments': [[1]], 'begin': 0, 'end': 1, 'more': 0, 'cut_short': ''},
    {'moments': [], 'begin': 0, 'end': 1, 'more': 0, 'cut_short': ''},
    {'moments': [[1, 'a']], 'begin': 0, 'end': 1, 'more': float('inf'), 'cut_short': ''},
    {'moments': [[1, 'a']], 'begin': 2, 'end': 3, 'more': 0, 'cut_short': ''},
    {'moments': [[3, 'a']], 'begin': 2, 'end': 1, 'more': 0, 'cut_short': ''},
    {'moments': [[-1, 'a']], 'begin': 0, 'end': 1, 'more': 0, 'cut_short': ''},
    {'moments': [[1, 'a']], 'begin': True, 'end': 1, 'more': 0, 'cut_short': ''},
])  # fmt: skip
def test_what_is_no_event_is_none(entries):
    assert from_entries(entries) is None
