"""Corners of a floor that point into it: paths turn at them, and rims pass them."""

from __future__ import annotations

from math import cos, pi
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import Polygon
from shapely.geometry.polygon import orient

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Column = NDArray[np.float64]

QUARTER = 8
"""Straight pieces of a quarter of an arc round a corner."""

ROUND = 1.0 / cos(pi / (4 * QUARTER))
"""[-] A polygon on a circle so much larger has the circle inside: 0.5 %."""

_ANGLES = (np.arange(4 * QUARTER) + 0.5) * (pi / (2 * QUARTER))
_CIRCLE = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=1)


def rings(part: Polygon) -> list[shapely.LinearRing]:
    """Return the edges of ``part`` with the floor on their left."""
    oriented = orient(part)
    return [oriented.exterior, *oriented.interiors]


def reflex(ring: shapely.LinearRing) -> Column:
    """Return the (n, 2) corners of ``ring`` that point into the floor on its left."""
    corners = np.array(ring.coords)[:-1]
    before, after = corners - np.roll(corners, 1, 0), np.roll(corners, -1, 0) - corners
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    into: Column = corners[turn < 0.0]
    return into


def inset(floor: shapely.Geometry, clearance: float) -> shapely.Geometry:
    """Return the part of ``floor`` no point of which is nearer than ``clearance`` [m] to an edge.

    Round a corner that points into it the edge is an arc of straight pieces; they lie outside the
    circle, as those of GEOS, which lie inside it, would come up to 0.5 % too near.
    """
    near = floor.buffer(-clearance, quad_segs=QUARTER)
    parts = [part for part in shapely.get_parts(floor) if isinstance(part, Polygon)]
    corners = np.vstack([reflex(ring) for part in parts for ring in rings(part)])
    if clearance == 0.0 or not len(corners):
        return near
    discs = shapely.polygons(corners[:, None] + clearance * ROUND * _CIRCLE)
    return near.difference(shapely.union_all(discs))
