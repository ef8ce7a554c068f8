"""The shortest path inside a zone: straight, and round the corners of edges and holes.

The shortest path in a polygon with holes turns only at corners that point into the floor, so it is
a shortest path in the visibility graph of those corners. One path is searched for; where more are
asked for, the distances between all corners are worked out once, and a path costs what its ends
see.

Sources: T. Lozano-Perez, M. A. Wesley, "An algorithm for planning collision-free paths among
polyhedral obstacles", Communications of the ACM 22(10), 1979; R. W. Floyd, "Algorithm 97: Shortest
path", Communications of the ACM 5(6), 1962.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Polygon

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.corners import reflex, rings
from agv_motion.motion.navigation.polyline import ROUNDING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.zone import Zone

    Column = NDArray[np.float64]


class PathPlanner:
    """Paths inside one zone; the graph of its corners is made once, when it is worth it."""

    def __init__(self, zone: Zone, parts: Sequence[Polygon] | None = None) -> None:
        """Make the graph of each walkable part.

        Args:
            zone: Where the tree walks.
            parts: What of its walkable floor is free; None: all of it.

        """
        self.zone = zone
        self._free = list(zone.parts if parts is None else parts)
        self._parts = [VisibilityGraph(part) for part in self._free]

    def without(self, taken: shapely.Geometry) -> PathPlanner:
        """Return the paths that keep off ``taken``, an area that others need."""
        left = (shapely.get_parts(part.difference(taken)) for part in self._free)
        polygons = [p for parts in left for p in parts if isinstance(p, Polygon) and p.area > 0.0]
        return PathPlanner(self.zone, polygons)

    def path(self, start: Point, goal: Point) -> list[Point]:
        """Return the corners of the shortest path, its ends included.

        A start outside the walkable floor is led to the nearest point of it first.

        Args:
            start: Where the platform is, in the map [m].
            goal: Where it should go, in the map [m].

        Raises:
            GeometryError: The goal is not walkable or not free, or no way leads there.

        """
        inside, graph = self._connected(start, goal)
        path = graph.shortest(inside, goal)
        return path if inside == start else [start, *path]

    def is_straight(self, start: Point, goal: Point) -> bool:
        """Return whether the path from ``start`` to ``goal`` [m] is one line: without looking on.

        Raises:
            GeometryError: As :meth:`path`.

        """
        inside, graph = self._connected(start, goal)
        return inside == start and graph.sees(start, goal)

    def failure(self, start: Point, goal: Point) -> GeometryError | None:
        """Return why no path leads from ``start`` to ``goal`` [m]; None if one does."""
        try:
            self._connected(start, goal)
        except GeometryError as error:
            return error
        return None

    def _connected(self, start: Point, goal: Point) -> tuple[Point, VisibilityGraph]:
        """Return where the path enters walkable floor, and the graph of the part it leads through.

        Raises:
            GeometryError: As by :meth:`path`.

        """
        zone = self.zone
        if not zone.walkable(*goal):
            msg = f'goal ({goal[0]:.2f}, {goal[1]:.2f}) {zone.why_not(*goal)}: choose another'
            raise GeometryError(msg)
        inside = start if zone.walkable(*start) else zone.way_back(*start)
        graph = next((g for g in self._parts if g.covers(goal)), None)
        if graph is None:
            msg = f'goal ({goal[0]:.2f}, {goal[1]:.2f}) lies where another tree is or goes: wait'
            raise GeometryError(msg)
        if not graph.covers(inside):
            msg = (
                f'goal ({goal[0]:.2f}, {goal[1]:.2f}) lies in another part of the zone than '
                f'({start[0]:.2f}, {start[1]:.2f}): the passage is taken, or narrower than the '
                'margins'
            )
            raise GeometryError(msg)
        return inside, graph


class VisibilityGraph:
    """Corners of one polygon that point into it, and the shortest path between any two.

    Floor that is free for a moment is asked for one path, which needs to look from a few corners
    only; the distances between all of them are worked out when a second path is asked for.
    """

    def __init__(self, part: Polygon) -> None:
        """Find the corners of ``part``."""
        self._floor = part.buffer(ROUNDING)  # paths along an edge are none that cut it
        shapely.prepare(self._floor)
        self._corners = np.vstack([reflex(ring) for ring in rings(part)])
        self._asked_before = False

    @cached_property
    def _step(self) -> Column:
        """Distance of each two corners that see each other [m]."""
        count = len(self._corners)
        step: Column = np.full((count, count), np.inf)
        for i in range(count):
            step[i, :i] = step[:i, i] = self._seen(self._corner(i), self._corners[:i])
        return step

    @cached_property
    def _distance(self) -> Column:
        """Length of the shortest path between each two corners [m]."""
        distance = self._step.copy()
        np.fill_diagonal(distance, 0.0)
        for k in range(len(self._corners)):
            np.minimum(distance, distance[:, k, None] + distance[None, k, :], out=distance)
        return distance

    def covers(self, point: Point) -> bool:
        """Return whether ``point`` lies in this part."""
        return bool(shapely.intersects_xy(self._floor, *point))

    def sees(self, start: Point, goal: Point) -> bool:
        """Return whether the straight line between two points stays in this part."""
        return bool(shapely.covers(self._floor, LineString([start, goal])))

    def shortest(self, start: Point, goal: Point) -> list[Point]:
        """Return the shortest path between two points of this part.

        Raises:
            GeometryError: There is none, which a connected part rules out but for rounding.

        """
        if self.sees(start, goal):
            return [start, goal]
        find = self._looked_up if self._asked_before else self._searched
        self._asked_before = True
        corners = find(start, goal)
        if not corners:
            msg = f'no way from ({start[0]:.2f}, {start[1]:.2f}) to ({goal[0]:.2f}, {goal[1]:.2f})'
            raise GeometryError(msg)
        return [start, *map(self._corner, corners), goal]

    def _looked_up(self, start: Point, goal: Point) -> list[int]:
        """Return the corners of the shortest path by the distances of all; empty: there is none."""
        to_start, to_goal = (self._seen(end, self._corners) for end in (start, goal))
        total = to_start[:, None] + self._distance + to_goal[None, :]
        if not total.size or not np.isfinite(total.min()):
            return []
        here, last = (int(i) for i in np.unravel_index(total.argmin(), total.shape))
        corners = [here]
        while here != last and len(corners) <= len(self._corners):
            here = int((self._step[here] + self._distance[:, last]).argmin())
            corners.append(here)
        return corners

    def _searched(self, start: Point, goal: Point) -> list[int]:
        """Return the corners of the shortest path by the A* search; empty: there is none.

        Source: P. E. Hart, N. J. Nilsson, B. Raphael, "A formal basis for the heuristic
        determination of minimum cost paths", IEEE Transactions on Systems Science and Cybernetics
        4(2), 1968. What is left is at least the straight line, so each corner is looked from once,
        and only at those that it might bring nearer.
        """
        corners, count = self._corners, len(self._corners)
        best, to_goal = (self._seen(end, corners) for end in (start, goal))
        left = np.hypot(corners[:, 0] - goal[0], corners[:, 1] - goal[1])
        before, ahead = np.full(count, -1), np.ones(count, bool)
        shortest, last = np.inf, -1
        while count:
            estimate = np.where(ahead, best + left, np.inf)
            here = int(estimate.argmin())
            if estimate[here] >= shortest:
                break
            ahead[here] = False
            if best[here] + to_goal[here] < shortest:
                shortest, last = best[here] + to_goal[here], here
            step = np.hypot(*(corners - corners[here]).T)
            bound = np.minimum(best, shortest - left)
            near = np.flatnonzero(ahead & (best[here] + step < bound))
            through = best[here] + self._seen(self._corner(here), corners[near])
            nearer = through < best[near]
            best[near[nearer]], before[near[nearer]] = through[nearer], here
        path = [last] if last >= 0 else []
        while path and before[path[0]] >= 0:
            path.insert(0, int(before[path[0]]))
        return path

    def _corner(self, i: int) -> Point:
        return float(self._corners[i, 0]), float(self._corners[i, 1])

    def _seen(self, point: Point, corners: Column) -> Column:
        """Return the distance of ``point`` to each of ``corners``; infinite where it is hidden."""
        ends = np.stack([np.broadcast_to(np.asarray(point), corners.shape), corners], 1)
        seen = shapely.covers(self._floor, shapely.linestrings(ends))
        away = np.hypot(corners[:, 0] - point[0], corners[:, 1] - point[1])
        distances: Column = np.where(seen, away, np.inf)
        return distances
