"""Two trees that do not hear each other keep clear, each on its own side."""

from __future__ import annotations

from math import dist

import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.motion.navigation.polyline import line
from agv_motion.motion.navigation.reservations.sides import Sides

PLACES = st.tuples(st.floats(-9, 9), st.floats(-9, 9))
PATHS = st.lists(PLACES, min_size=1, max_size=3, unique=True).map(tuple)


@given(PATHS, PATHS, PLACES, PLACES)
def test_two_places_each_on_its_own_side_keep_the_clearance(a, b, p, q):
    """The largest clearance with which both may be where they are is one that they keep."""
    one, other = Sides(line(a), line(b)), Sides(line(b), line(a))
    place, opposite = shapely.Point(p), shapely.Point(q)
    clearance = min(
        place.distance(line(b)) - place.distance(line(a)),
        opposite.distance(line(a)) - opposite.distance(line(b)),
    )
    assert one.allow((p,), clearance - 1e-9)
    assert other.allow((q,), clearance - 1e-9)
    assert not (one.allow((p,), clearance + 1e-9) and other.allow((q,), clearance + 1e-9))
    assert dist(p, q) >= clearance - 1e-9


def test_a_path_that_leaves_its_side_is_refused():
    sides = Sides(line(((0.0, 0.0),)), line(((10.0, 0.0),)))
    assert sides.allow(((0.0, 0.0), (3.9, 0.0)), 2.0)
    assert not sides.allow(((0.0, 0.0), (4.1, 0.0)), 2.0)


def test_the_other_side_is_closed_in_squares():
    sides = Sides(line(((0.0, 0.0),)), line(((10.0, 0.0),)))
    closed = sides.closed((-2.0, -2.0, 12.0, 2.0), 2.0)
    assert closed.covers(shapely.Point(10.0, 0.0))
    assert not closed.intersects(shapely.Point(3.0, 0.0))
