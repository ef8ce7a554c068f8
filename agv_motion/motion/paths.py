"""The shortest way inside a zone: straight, and round the corners of edges and holes.

The shortest path in a polygon with holes turns only at its corners, so it is a shortest path in
the visibility graph of those corners.

Source: T. Lozano-Perez, M. A. Wesley, "An algorithm for planning collision-free paths among
polyhedral obstacles", Communications of the ACM 22(10), 1979.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

import networkx as nx
import numpy as np
import shapely

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from shapely import Polygon

    from agv_motion.motion.zone import Zone

    Point = tuple[float, float]

TOLERANCE = 1e-6
"""[m] by which a way may cut an edge, so that ways along an edge are not refused by rounding."""

Start, Goal = -1, -2
"""Names of the two ends in the graph, whose corners are numbered from 0."""


class Paths:
    """Ways inside one zone; the visibility graph of its corners is made once."""

    def __init__(self, zone: Zone) -> None:
        """Make the graph of each walkable part."""
        self._zone = zone
        self._parts = [_VisibilityGraph(part) for part in zone.parts]

    def way(self, start: Point, goal: Point) -> list[Point]:
        """Return the corners of the shortest way, its ends included.

        A start outside the walkable floor is led to the nearest point of it first.

        Args:
            start: Where the platform is, in the map [m].
            goal: Where it should go, in the map [m].

        Raises:
            GeometryError: The goal is not walkable, or lies in another part of the zone.

        """
        zone = self._zone
        if not zone.walkable(*goal):
            msg = f'goal ({goal[0]:.2f}, {goal[1]:.2f}) {zone.why_not(*goal)}: choose another'
            raise GeometryError(msg)
        inside = start if zone.walkable(*start) else zone.nearest_walkable(*start)
        graph = next((g for g in self._parts if g.covers(goal)), self._parts[0])
        if not graph.covers(inside):
            msg = (
                f'goal ({goal[0]:.2f}, {goal[1]:.2f}) lies in another part of the zone than '
                f'({start[0]:.2f}, {start[1]:.2f}): the passage is narrower than the margins'
            )
            raise GeometryError(msg)
        way = graph.shortest(inside, goal)
        return way if inside == start else [start, *way]


class _VisibilityGraph:
    """Corners of one polygon, joined where a straight way between them stays inside."""

    def __init__(self, part: Polygon) -> None:
        self._floor = part.buffer(TOLERANCE)
        shapely.prepare(self._floor)
        rings = [part.exterior, *part.interiors]
        self._corners = np.vstack([np.array(ring.coords)[:-1] for ring in rings])
        self._graph: nx.Graph[int] = nx.Graph()
        self._graph.add_nodes_from(range(len(self._corners)))
        for i, corner in enumerate(self._corners):
            self._join(self._graph, i, corner, self._corners[:i])

    def covers(self, point: Point) -> bool:
        """Return whether ``point`` lies in this part."""
        return bool(shapely.intersects_xy(self._floor, *point))

    def shortest(self, start: Point, goal: Point) -> list[Point]:
        """Return the shortest way between two points of this part."""
        if bool(shapely.covers(self._floor, shapely.LineString([start, goal]))):
            return [start, goal]
        graph = self._graph.copy()
        for name, end in ((Start, start), (Goal, goal)):
            self._join(graph, name, np.array(end), self._corners)
        corners = nx.dijkstra_path(graph, Start, Goal)[1:-1]
        return [start, *((float(x), float(y)) for x, y in self._corners[corners]), goal]

    def _join(
        self,
        graph: nx.Graph[int],
        name: int,
        point: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
        corners: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    ) -> None:
        """Join ``point`` to each of ``corners`` that it sees, by the distance."""
        if not len(corners):
            return
        lines = shapely.linestrings(np.stack([np.broadcast_to(point, corners.shape), corners], 1))
        for i in np.flatnonzero(shapely.covers(self._floor, lines)):
            graph.add_edge(name, int(i), weight=hypot(*(corners[i] - point)))


def next_waypoint(way: list[Point], reach: float) -> Point:
    """Return the first corner of ``way`` that is further from its start than ``reach`` [m]."""
    x, y = way[0]
    return next((p for p in way[1:-1] if hypot(p[0] - x, p[1] - y) > reach), way[-1])
