"""Corners that point into a floor, and what a clearance leaves of it."""

from __future__ import annotations

import pytest
import shapely

from agv_motion.motion.navigation.corners import inset, reflex, rings

SQUARE = shapely.box(0.0, 0.0, 10.0, 10.0)
COLUMN = shapely.box(4.0, 4.0, 6.0, 6.0)
AROUND = SQUARE.difference(COLUMN)


def test_only_the_corners_of_a_hole_point_into_a_convex_floor():
    outer, hole = rings(AROUND)
    assert len(reflex(outer)) == 0
    assert {tuple(corner) for corner in reflex(hole)} == {(4, 4), (4, 6), (6, 4), (6, 6)}


def test_the_inner_corner_of_an_angle_points_into_it():
    angle = shapely.Polygon([(0, 0), (9, 0), (9, 3), (3, 3), (3, 9), (0, 9)])
    (ring,) = rings(angle)
    assert reflex(ring).tolist() == [[3.0, 3.0]]


@pytest.mark.parametrize('clearance', [0.1, 0.5, 1.0])
def test_no_point_of_the_inset_is_nearer_to_an_edge_than_the_clearance(clearance):
    left = inset(AROUND, clearance)
    assert left.distance(AROUND.boundary) == pytest.approx(clearance, rel=0.006)
    assert left.distance(AROUND.boundary) >= clearance - 1e-9


def test_no_clearance_leaves_all():
    assert inset(AROUND, 0.0).area == pytest.approx(96.0)


def test_a_corner_is_judged_by_its_two_edges_alone():
    """An arrow head: the notch points into the floor, the points beside it do not."""
    (ring,) = rings(shapely.Polygon([(3, 8), (0, 0), (7, 6), (2, 2)]))
    assert reflex(ring).tolist() == [[2.0, 2.0]]
