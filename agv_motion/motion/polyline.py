"""Ways as corners joined by straight lines: cut, measured, and found one's place on."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

import numpy as np
import shapely

if TYPE_CHECKING:
    from collections.abc import Sequence

Point = tuple[float, float]
Way = tuple[Point, ...]

SAME = 1e-9
"""[m] Points nearer than this are one."""


def length(way: Sequence[Point]) -> float:
    """Return the length of ``way`` [m]."""
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(way))


def cut(way: Sequence[Point], at: float) -> tuple[Way, Way]:
    """Return ``way`` up to ``at`` [m] from its start, and the rest; both hold the point between."""
    gone = 0.0
    for i, (a, b) in enumerate(pairwise(way)):
        step = hypot(b[0] - a[0], b[1] - a[1])
        if step > 0.0 and gone + step >= at:
            share = max((at - gone) / step, 0.0)
            point = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
            return joined(way[: i + 1], (point,)), joined((point,), way[i + 1 :])
        gone += step
    return tuple(way), (way[-1],)


def nearest(way: Sequence[Point], place: Point) -> tuple[float, float]:
    """Return how far along ``way`` it comes nearest to ``place``, and how near [m]."""
    best, along, gone = hypot(place[0] - way[0][0], place[1] - way[0][1]), 0.0, 0.0
    for a, b in pairwise(way):
        x, y = b[0] - a[0], b[1] - a[1]
        step = hypot(x, y)
        share = ((place[0] - a[0]) * x + (place[1] - a[1]) * y) / (step * step) if step else 0.0
        share = min(max(share, 0.0), 1.0)
        away = hypot(place[0] - a[0] - share * x, place[1] - a[1] - share * y)
        if away < best:
            best, along = away, gone + share * step
        gone += step
    return along, best


def joined(first: Sequence[Point], second: Sequence[Point]) -> Way:
    """Return both ways as one, without points that are there twice in a row."""
    way: list[Point] = []
    for point in (*first, *second):
        if not way or hypot(point[0] - way[-1][0], point[1] - way[-1][1]) > SAME:
            way.append(point)
    return tuple(way)


def line(way: Sequence[Point]) -> shapely.Geometry:
    """Return ``way`` as a geometry: a point, a line, or empty."""
    return _line(tuple(way))


@lru_cache(maxsize=256)
def _line(way: Way) -> shapely.Geometry:
    """Return ``way`` as a geometry; the same few ways are looked at again and again."""
    if not way:
        return EMPTY
    return shapely.LineString(way) if len(way) > 1 else shapely.Point(way[0])


EMPTY = shapely.GeometryCollection()


def straight_pieces(way: shapely.Geometry) -> list[shapely.Geometry]:
    """Return the straight pieces of what :func:`line` made, one after the other."""
    points = shapely.get_coordinates(way)
    if len(points) < 2:
        return [way]
    return list(shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)))
