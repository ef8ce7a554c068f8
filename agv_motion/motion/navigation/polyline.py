"""Paths as corners joined by straight lines: cut, measured, and found one's place on."""

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
Path = tuple[Point, ...]

SAME = 1e-9
"""[m] Points nearer than this are one."""

ROUNDING = 1e-6
"""[m] by which a place may lie off the floor or the path that it is on, as GEOS rounds"""


def length(path: Sequence[Point]) -> float:
    """Return the length of ``path`` [m]."""
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(path))


def cut(path: Sequence[Point], at: float) -> tuple[Path, Path]:
    """Return ``path`` up to ``at`` [m] from its start, and the rest; both hold the point there."""
    gone = 0.0
    for i, (a, b) in enumerate(pairwise(path)):
        step = hypot(b[0] - a[0], b[1] - a[1])
        if step > 0.0 and gone + step >= at:
            share = max((at - gone) / step, 0.0)
            point = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
            return joined(path[: i + 1], (point,)), joined((point,), path[i + 1 :])
        gone += step
    return tuple(path), (path[-1],)


def nearest(path: Sequence[Point], place: Point) -> tuple[float, float]:
    """Return how far along ``path`` it comes nearest to ``place``, and how near [m]."""
    best, along, gone = hypot(place[0] - path[0][0], place[1] - path[0][1]), 0.0, 0.0
    for a, b in pairwise(path):
        x, y = b[0] - a[0], b[1] - a[1]
        step = hypot(x, y)
        share = ((place[0] - a[0]) * x + (place[1] - a[1]) * y) / (step * step) if step else 0.0
        share = min(max(share, 0.0), 1.0)
        away = hypot(place[0] - a[0] - share * x, place[1] - a[1] - share * y)
        if away < best:
            best, along = away, gone + share * step
        gone += step
    return along, best


def joined(first: Sequence[Point], second: Sequence[Point]) -> Path:
    """Return both paths as one, without points that are there twice in a row."""
    path: list[Point] = []
    for point in (*first, *second):
        if not path or hypot(point[0] - path[-1][0], point[1] - path[-1][1]) > SAME:
            path.append(point)
    return tuple(path)


def line(path: Sequence[Point]) -> shapely.Geometry:
    """Return ``path`` as a geometry: a point, a line, or empty."""
    return _line(tuple(path))


@lru_cache(maxsize=256)
def _line(path: Path) -> shapely.Geometry:
    """Return ``path`` as a geometry; the same few paths are looked at again and again."""
    if not path:
        return EMPTY
    return shapely.LineString(path) if len(path) > 1 else shapely.Point(path[0])


EMPTY = shapely.GeometryCollection()


def straight_pieces(path: shapely.Geometry) -> list[shapely.Geometry]:
    """Return the straight pieces of what :func:`line` made, one after the other."""
    points = shapely.get_coordinates(path)
    if len(points) < 2:
        return [path]
    return list(shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)))
