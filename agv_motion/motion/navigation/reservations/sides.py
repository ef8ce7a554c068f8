"""How two trees that no longer hear each other share the floor, without a word."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from agv_motion.motion.navigation.polyline import length, line

if TYPE_CHECKING:
    from agv_motion.motion.navigation.polyline import Path

STRIDE = 0.05
"""[m] between the places at which a path is tested against the border of two sides."""

SQUARE = 0.5
"""[m] Edge of the squares in which the floor of the other side is told."""


class Sides(NamedTuple):
    """How two trees that do not hear each other share the floor: each keeps to what is nearer.

    With A and B what they held last, a tree at p keeps ``d(p, A) + c <= d(p, B)``, the other at q
    ``d(q, B) + c <= d(q, A)``. By the triangle inequality ``d(p, B) <= |pq| + d(q, B)`` and
    ``d(q, A) <= |pq| + d(p, A)``; added up, ``|pq| >= c``: they stay clear without a word.
    """

    own: shapely.Geometry
    """what this tree held when the other fell silent"""
    theirs: shapely.Geometry
    """all that the other may have held then"""

    def allow(self, path: Path, clearance: float) -> bool:
        """Return whether all of ``path`` lies on this tree's side.

        Both distances change by at most one metre a metre, so between two tested places the
        difference is off by no more than the distance between the two.
        """
        count = max(int(length(path) / STRIDE) + 1, 2)
        places = line(path)
        if len(path) > 1:
            places = shapely.line_interpolate_point(
                places, np.linspace(0.0, 1.0, count), normalized=True
            )
        slack = length(path) / (count - 1)
        own, theirs = shapely.distance(places, self.own), shapely.distance(places, self.theirs)
        return bool(np.all(own + clearance + slack <= theirs))

    def closed(
        self, bounds: tuple[float, float, float, float], clearance: float
    ) -> shapely.Geometry:
        """Return, in squares, the part of a rectangle that does not lie on this tree's side.

        Args:
            bounds: Smallest x and y, largest x and y of the rectangle [m].
            clearance: Between the two trees [m].

        """
        west, south, east, north = bounds
        half = SQUARE / 2.0
        x, y = np.meshgrid(
            np.arange(west + half, east + half, SQUARE),
            np.arange(south + half, north + half, SQUARE),
        )
        places = shapely.points(x, y)
        away = shapely.distance(places, self.theirs) - shapely.distance(places, self.own)
        out = away < clearance + STRIDE
        x, y = x[out], y[out]
        return shapely.union_all(shapely.box(x - half, y - half, x + half, y + half))
