"""Detours past floor that others need, and places to give way at."""

from __future__ import annotations

from math import cos, hypot, inf, pi
from typing import TYPE_CHECKING

import shapely
from shapely import Polygon

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.polyline import ROUNDING, Path, joined, straight_pieces
from agv_motion.motion.navigation.reservations.needs import ARRIVED, COURTESY
from agv_motion.motion.navigation.reservations.separation import apart, keeps_away

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.reservations.needs import Need, Needs
    from agv_motion.motion.navigation.reservations.separation import Floor
    from agv_motion.motion.navigation.zone import Zone

QUARTER = 3
"""Corners of a quarter of a round obstacle; few, since each costs time."""

ROUND = 1.0 / cos(pi / (4 * QUARTER)) + 1e-4
"""[-] A polygon on a circle so much larger has the circle inside."""


NEAR = 0.8
"""[m] how near to the goal a detour may end where the goal itself is not free"""


class Detours:
    """What one tree may do where its way is barred: go round, or out of the way."""

    def __init__(self, zone: Zone, needs: Needs) -> None:
        """Look at what the others need in ``zone``."""
        self._zone, self._needs = zone, needs

    def occupied(self) -> shapely.Geometry:
        """Return the floor that others hold or ask for, with the clearance to keep from it."""
        return taken(self._needs.of_all(plans=False))

    def past_all(self, place: Point, goal: Point) -> Path | None:
        """Return the shortest path from ``place`` to ``goal`` past all that others need."""
        needs = self._needs
        floor = free_floor(self._zone, place, taken(needs.of_all()), needs.held())
        return None if floor is None else detour(self._zone, place, goal, floor, NEAR)

    def to_refuge(self, place: Point) -> Path | None:
        """Return the path to a refuge; None where there is none, or the tree bars nobody's way."""
        here = shapely.Point(place)
        if all(apart(here, *planned) for planned in self._needs.plans(inf, 0.0)):
            return None
        floor = free_floor(self._zone, place, self.occupied(), self._needs.held())
        if floor is None:
            return None
        for reach in (inf, COURTESY):
            planned = taken(self._needs.plans(reach, 2.0 * ARRIVED))
            path = refuge(self._zone, place, floor, planned)
            if path is not None:
                return path
        return None


def taken(lines: Iterable[Need]) -> shapely.Geometry:
    """Return the floor nearer to any of some paths than the clearance given with each [m].

    Each straight piece of a path is widened by itself: GEOS leaves a hole where a whole path bends
    round a point at just the clearance, as one does that leads round another tree.
    """
    return shapely.union_all(
        [
            shapely.buffer(piece, clearance * ROUND, quad_segs=QUARTER)
            for path, clearance in lines
            for piece in straight_pieces(path)
        ]
    )


def free_floor(
    zone: Zone,
    place: Point,
    blocked: shapely.Geometry,
    held: Iterable[tuple[Floor, float]] = (),
) -> Polygon | None:
    """Return the connected piece of walkable floor outside ``blocked`` at, or nearest to, a place.

    Args:
        zone: Where the tree walks.
        place: Where it is [m].
        blocked: What others need.
        held: What of it they hold, and the clearance to keep from each [m].

    Returns:
        None where no straight step leads to free floor without leaving what may be walked on, or
        through floor that another holds.

    """
    here = shapely.Point(place)
    ground = next((part for part in zone.parts if part.distance(here) < ROUNDING), zone.floor)
    pieces = [
        piece
        for part in zone.parts
        for piece in shapely.get_parts(part.difference(blocked))
        if isinstance(piece, Polygon) and piece.area > 0.0
    ]
    ground, held = ground.buffer(ROUNDING), list(held)
    for piece in sorted(pieces, key=here.distance):
        step = shapely.shortest_line(here, piece)
        path = (place, tuple(step.coords[-1]))
        if shapely.covers(ground, step) and all(keeps_away(path, *floor) for floor in held):
            return piece
    return None


def detour(zone: Zone, place: Point, goal: Point, floor: Polygon, near: float) -> Path | None:
    """Return the shortest path from ``place`` on ``floor`` to, or to within ``near`` of, ``goal``.

    Args:
        zone: Where the tree walks.
        place: Where it is [m].
        goal: Where it wants to be [m].
        floor: What of the zone is free.
        near: How near to the goal is good enough where the goal itself is not free [m].

    """
    start, end = _nearest(floor, place), _nearest(floor, goal)
    if hypot(end[0] - goal[0], end[1] - goal[1]) > near:
        return None
    try:
        return joined((place,), PathPlanner(zone, [floor]).path(start, end))
    except GeometryError:  # by rounding alone, since the floor is connected
        return None


def refuge(zone: Zone, place: Point, floor: Polygon, wished: shapely.Geometry) -> Path | None:
    """Return the path to a place near by at which the tree is off the floor ``wished`` by another.

    Args:
        zone: Where the tree walks.
        place: Where it is [m].
        floor: What of the zone is free.
        wished: Where it is in the way.

    """
    off = floor.difference(wished)
    if off.is_empty:
        return None
    return detour(zone, place, _nearest(off, place), floor, 0.0)


def _nearest(floor: shapely.Geometry, place: Point) -> Point:
    if shapely.intersects_xy(floor, *place):
        return place
    point = shapely.shortest_line(floor, shapely.Point(place)).coords[0]
    return point[0], point[1]
