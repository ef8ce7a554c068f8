"""Whether a path keeps clear of floor that another tree holds, or at least leads away from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from agv_motion.motion.navigation.polyline import ROUNDING, cut, length, line

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.motion.navigation.polyline import Path


SAMPLE = 0.05
"""[m] between the places at which a path is tested."""


class Floor(NamedTuple):
    """Floor that another tree may be on."""

    line: shapely.Geometry
    """where its centre may be"""
    corners: shapely.Geometry
    """the points of that path: where its centre was, where it may have got to, and of one that does
    not know where it is each place where it may be"""

    @classmethod
    def of(cls, path: Path) -> Floor:
        """Return the floor of a tree whose centre may be anywhere on ``path``."""
        return cls(line(path), shapely.multipoints(path))

    def things(self) -> tuple[shapely.Geometry, ...]:
        """Return the path, and each of its corners by itself."""
        return self.line, *shapely.get_parts(self.corners)


def apart(a: shapely.Geometry, b: shapely.Geometry, clearance: float) -> bool:
    """Return whether two paths keep ``clearance`` [m]; nothing keeps it from anything."""
    return bool(not a.distance(b) < clearance - ROUNDING)  # the distance of an empty one is NaN


def keeps_away(path: Path, floor: Floor, clearance: float) -> bool:
    """Return whether ``path`` keeps ``clearance`` [m] from ``floor``, or leads away from it.

    Where it begins nearer, neither the floor nor any corner of it may come nearer on any metre: so
    who stands on another's floor may leave it, not walk along it, and nothing else.
    """
    whole = line(path)
    if apart(whole, floor.line, clearance):
        return True
    places = _places(path)
    return all(
        bool(whole.distance(thing) >= min(float(away[0]), clearance) - ROUNDING)
        and not _nearer(away, clearance).any()
        for thing in floor.things()
        for away in (shapely.distance(places, thing),)
    )


def free_part(path: Path, floor: Floor, clearance: float, least: float = 0.0) -> Path:
    """Return ``path`` up to where it no longer keeps away from ``floor``.

    Args:
        path: From where the tree is.
        floor: Of another tree.
        clearance: To keep from it [m].
        least: A shorter piece is none [m].

    """
    if len(path) < 2 or keeps_away(path, floor, clearance):
        return path
    places = _places(path)
    bad = np.zeros(len(places), bool)
    for thing in floor.things():
        bad |= _nearer(shapely.distance(places, thing), clearance)
    first = int(np.flatnonzero(bad)[0]) if bad.any() else len(places)
    upto = length(path) * (first - 1) / (len(places) - 1)
    while upto > max(least, ROUNDING):
        short = cut(path, upto)[0]
        if keeps_away(short, floor, clearance):
            return short
        upto /= 2.0
    return path[:1]


def _places(path: Path) -> NDArray[np.object_]:
    """Return points along ``path``, both ends among them."""
    if len(path) < 2:
        return np.array([line(path)], dtype=object)
    count = max(int(length(path) / SAMPLE) + 2, 2)
    share = np.linspace(0.0, 1.0, count)
    places: NDArray[np.object_] = shapely.line_interpolate_point(line(path), share, normalized=True)
    return places


def _nearer(away: NDArray[np.float64], clearance: float) -> NDArray[np.bool_]:
    """Return at which places a path is nearer than before, and nearer than ``clearance``."""
    farthest = np.minimum(np.maximum.accumulate(away), clearance)
    nearer: NDArray[np.bool_] = away < farthest - ROUNDING
    return nearer
