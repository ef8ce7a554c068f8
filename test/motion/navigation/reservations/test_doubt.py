"""Where a tree may be whose pose jumps: all places it was taken to be at, until it is sure."""

from __future__ import annotations

import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.motion.navigation.polyline import line
from agv_motion.motion.navigation.reservations.doubt import MOST_PLACES, jumped

HELD = ((0.0, 0.0), (4.0, 0.0))
TOLERANCE = 0.3


def test_on_its_way_there_is_no_doubt():
    assert jumped(HELD, (2.0, 0.29), TOLERANCE, 5.0) is None


def test_off_its_way_it_may_be_here_or_there():
    doubt = jumped(HELD, (2.0, 3.0), TOLERANCE, 5.0)
    assert doubt.floor == ((2.0, 3.0), *HELD)
    assert '3.00 m off its way, more than the tolerance of 0.3 m' in doubt.why
    assert doubt.seen((2.1, 3.1), TOLERANCE, 6.0) is doubt, 'it agrees'


def test_a_fix_that_goes_to_and_fro_begins_the_time_anew_and_takes_no_more_floor():
    doubt = jumped(HELD, (2.0, 3.0), TOLERANCE, 5.0)
    back = doubt.seen((1.0, 0.1), TOLERANCE, 9.0)
    assert (back.places, back.since) == (((1.0, 0.0), (2.0, 3.0)), 9.0)
    again = back.seen((2.2, 3.0), TOLERANCE, 12.0)
    assert (again.places, again.since) == (((2.0, 3.0), (1.0, 0.0)), 12.0)


def test_one_that_creeps_by_less_than_the_tolerance_at_a_time_is_seen():
    doubt = jumped(HELD, (2.0, 3.0), TOLERANCE, 0.0)
    for step in range(1, 11):
        doubt = doubt.seen((2.0, 3.0 + 0.11 * step), TOLERANCE, float(step))
    assert doubt.since == 9.0
    assert doubt.places[-1] == (2.0, 3.0)


PLACES = st.lists(st.tuples(st.floats(-9.0, 9.0), st.floats(-9.0, 9.0)), min_size=1, max_size=60)


@given(PLACES)
def test_what_was_held_before_and_the_latest_place_are_held_whatever_was_seen(places):
    doubt = None
    for now, place in enumerate(places):
        doubt = doubt.seen(place, TOLERANCE, now) if doubt else jumped(HELD, place, TOLERANCE, now)
        if doubt is not None:
            floor = line(doubt.floor)
            assert floor.distance(shapely.Point(place)) <= TOLERANCE
            assert floor.covers(line(HELD))
            assert len(doubt.floor) <= MOST_PLACES + 3
