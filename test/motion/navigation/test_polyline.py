"""Paths cut, measured and joined: worked examples, and laws over generated paths."""

from __future__ import annotations

from math import dist

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.motion.navigation.polyline import (
    cut,
    joined,
    length,
    line,
    nearest,
    straight_pieces,
)

CORNER = ((0.0, 0.0), (3.0, 0.0), (3.0, 4.0))
PLACES = st.tuples(st.floats(-9, 9), st.floats(-9, 9))
PATHS = st.lists(PLACES, min_size=2, max_size=6, unique=True).map(tuple)


def test_a_path_is_as_long_as_its_pieces():
    assert length(CORNER) == 7.0
    assert length(CORNER[:1]) == 0.0


def test_a_path_is_cut_between_its_corners_and_at_one():
    assert cut(CORNER, 5.0) == (((0.0, 0.0), (3.0, 0.0), (3.0, 2.0)), ((3.0, 2.0), (3.0, 4.0)))
    assert cut(CORNER, 3.0) == (CORNER[:2], CORNER[1:])
    assert cut(CORNER, 8.0) == (CORNER, CORNER[-1:])
    assert cut(CORNER, 0.0) == cut(CORNER, -1.0) == (CORNER[:1], CORNER)
    short = ((0.0, 0.0), (0.0, 0.0), (0.5, 0.0))
    assert cut(short, 0.25) == (((0.0, 0.0), (0.25, 0.0)), ((0.25, 0.0), (0.5, 0.0)))


def test_the_nearest_place_lies_on_a_piece_or_at_a_corner():
    assert nearest(CORNER, (1.0, 2.0)) == (1.0, 2.0)
    assert nearest(CORNER, (4.0, -1.0)) == (3.0, pytest.approx(2.0**0.5))
    assert nearest(CORNER, (-1.0, 0.0)) == (0.0, 1.0)
    assert nearest(CORNER, (5.0, 3.0)) == (6.0, 2.0)
    assert nearest(((1.0, 1.0), (1.0, 1.0), (1.5, 1.0)), (1.5, 3.0)) == (0.5, 2.0)
    assert nearest(CORNER[:1], (3.0, 4.0)) == (0.0, 5.0)


@given(PATHS, st.floats(0.0, 1.0))
def test_both_parts_of_a_cut_are_together_as_long_as_the_path(path, share):
    whole = length(path)
    first, second = cut(path, share * whole)
    assert length(first) + length(second) == pytest.approx(whole, abs=1e-8)
    assert dist(first[-1], second[0]) <= 1e-9


@given(PATHS, PLACES)
def test_no_point_of_a_path_is_nearer_than_the_nearest(path, place):
    along, away = nearest(path, place)
    assert away == pytest.approx(line(path).distance(shapely.Point(place)), abs=1e-9)
    assert dist(cut(path, along)[0][-1], place) == pytest.approx(away, abs=1e-6)


def test_joined_paths_hold_no_point_twice_in_a_row():
    assert joined(CORNER[:2], CORNER[1:]) == CORNER
    assert joined((), CORNER) == CORNER


def test_a_path_as_a_geometry():
    assert line(()).is_empty
    assert line(CORNER[:1]) == shapely.Point(0.0, 0.0)
    assert line(CORNER).length == 7.0
    assert [piece.length for piece in straight_pieces(line(CORNER))] == [3.0, 4.0]
    assert straight_pieces(line(CORNER[:1])) == [shapely.Point(0.0, 0.0)]
