"""Paths that keep clear of the floor of another, or lead away from it."""

from __future__ import annotations

from math import cos, sin, tau

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.motion.navigation.polyline import length, line
from agv_motion.motion.navigation.reservations.separation import Floor, free_part, keeps_away

CLEARANCE = 2.0
FLOOR = Floor(shapely.LineString([(0, 0), (6, 0)]), shapely.Point(0, 0))


@pytest.mark.parametrize(
    ('path', 'keeps'),
    [
        (((0.0, 2.0), (6.0, 2.0)), True),  # along it at just the clearance
        (((0.0, 3.0), (3.0, 1.9)), False),  # from outside into it
        (((3.0, 1.0), (3.0, 4.0)), True),  # straight out of it
        (((3.0, 1.0), (3.0, 0.9)), False),  # nearer
        (((3.0, 1.0), (3.0, -4.0)), False),  # through it and out on the other side
        (((3.0, 1.0), (3.0, 4.0), (3.0, 1.5)), False),  # out and in again
        (((1.0, 0.0), (0.5, 0.0)), False),  # along its middle, towards the tree
        (((1.0, 0.0), (5.0, 0.0)), True),  # along its middle, away from the tree
        (((3.0, 1.0),), True),  # nowhere
    ],
)
def test_examples(path, keeps):
    assert keeps_away(path, FLOOR, CLEARANCE) is keeps


PLACES = st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0))


@given(path=st.lists(PLACES, min_size=2, max_size=4, unique=True).map(tuple))
def test_what_is_free_of_a_way_never_leads_nearer_than_it_begins(path):
    free = free_part(path, FLOOR, CLEARANCE)
    assert free[0] == path[0]
    assert length(free) <= length(path) + 1e-9
    for thing in FLOOR:
        begins = min(shapely.Point(path[0]).distance(thing), CLEARANCE)
        assert line(free).distance(thing) >= begins - 1e-5


@given(angle=st.floats(0.0, tau), start=st.floats(2.0, 8.0))
def test_a_straight_way_at_a_tree_is_free_as_far_as_the_clearance(angle, start):
    """Of 6 m towards the centre all but the last 2 m are free, to 5 cm."""
    tree = Floor(shapely.Point(0, 0), shapely.Point(0, 0))
    path = ((start * cos(angle), start * sin(angle)), (0.0, 0.0))
    assert length(free_part(path, tree, CLEARANCE)) == pytest.approx(start - 2.0, abs=0.1)
