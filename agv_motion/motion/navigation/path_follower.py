"""The path that the tree is on: looked for when it must be, followed from corner to corner."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, inf
from typing import TYPE_CHECKING

import shapely
from shapely import LineString

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.polyline import cut, length, nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.motion.navigation.path_planner import Point
    from agv_motion.motion.navigation.zone import Zone

PLAN_PERIOD = 1.0
"""[s] between two looks for the path of a tree that is off it."""

PLAN_LIFETIME = 60.0
"""[s] after which the path is looked for anew in any case."""


class PathFollower:
    """The path to the goal, looked for now and then; and the paths that others leave free."""

    def __init__(self, zone: Zone, corner_reach: float, corner_slack: float) -> None:
        """Make the graph of all paths; see :class:`Waypoints` for the other two."""
        self._zone, self._reach = zone, corner_reach
        self._all = PathPlanner(zone)
        self._taken: shapely.Geometry | None = None
        self._free = self._all
        self._waypoints = Waypoints(zone, corner_reach, corner_slack)
        self._planned_at, self._planned_for = -inf, ((0.0, 0.0), self._all)
        self._path: tuple[Point, ...] = ((0.0, 0.0),)

    def free(self, avoid: shapely.Geometry | None = None) -> PathPlanner:
        """Return the paths off what others need; worked out once for each area."""
        if avoid is not self._taken:
            self._taken = avoid
            self._free = self._all if self._taken is None else self._all.without(self._taken)
        return self._free

    def to(
        self, time: float, here: Point, goal: Point, avoid: shapely.Geometry | None = None
    ) -> tuple[Point, ...]:
        """Return the corners of the path to ``goal``, the first to head for after ``here``.

        It is looked for anew when the goal or what others leave free has changed, when the tree
        is off it, and now and then.

        Raises:
            GeometryError: There is none.

        """
        wanted = goal, self.free(avoid)
        age = time - self._planned_at
        along, away = nearest(self._path, here)
        if (
            wanted != self._planned_for
            or not 0.0 <= age < PLAN_LIFETIME
            or (age >= PLAN_PERIOD and away > self._reach)
        ):
            self._planned_at = -inf
            self._path = self._look(here, goal)
            self._planned_at, self._planned_for = time, wanted
            along = 0.0
        self._path = cut(self._path, along)[1]
        return (here, *self._waypoints.ahead(here, self._path))

    def _look(self, here: Point, goal: Point) -> tuple[Point, ...]:
        """Return the path; a small step back into the margins is made on the path, not before."""
        path = tuple(self._free.path(here, goal))
        aside = hypot(path[1][0] - here[0], path[1][1] - here[1])
        return path if aside > self._reach or self._zone.walkable(*here) else path[1:]

    def distance(self, here: Point, goal: Point) -> float:
        """Return the length of the path to ``goal`` past nobody [m]; 0 if there is none."""
        try:
            return length(self._all.path(here, goal))
        except GeometryError:
            return 0.0


class Waypoints:
    """Which corner of a path to head for."""

    def __init__(self, zone: Zone, reach: float, slack: float) -> None:
        """Take the reach off the corners.

        Args:
            zone: Where the tree walks.
            reach: A corner nearer than this counts as reached [m] ...
            slack: ... unless skipping it would cut into the margin by more than this [m].

        """
        self._reach, self._slack = reach, slack
        self._floor = zone.floor.buffer(-max(zone.clearance - slack, 0.0))
        shapely.prepare(self._floor)

    def reached(self, place: Point, corners: Sequence[Point]) -> int:
        """Return how many of ``corners``, all ahead of ``place`` [m], count as reached."""
        for i, (corner, following) in enumerate(pairwise(corners)):
            if _distance(place, corner) > self._reach or not self._leads(place, following):
                return i
        return len(corners) - 1

    def ahead(self, place: Point, path: Sequence[Point]) -> tuple[Point, ...]:
        """Return the points to go to, each straight, so as to keep to a path that one may be off.

        Args:
            place: Where the platform is, in the map [m].
            path: The rest of its path, from the point nearest to ``place`` on [m].

        Returns:
            The corners not yet reached; where something stands before the next one, a point of
            the path ``reach`` ahead comes first.

        """
        start, corners = path[0], tuple(path[1:] or path)
        corners = corners[self.reached(place, corners) :]
        away = _distance(start, corners[0])
        off = _distance(place, start)
        if away <= self._reach or off <= self._slack or self._leads(place, corners[0]):
            return corners
        (x, y), share = corners[0], self._reach / away
        return (start[0] + share * (x - start[0]), start[1] + share * (y - start[1])), *corners

    def _leads(self, place: Point, to: Point) -> bool:
        return bool(shapely.covers(self._floor, LineString([place, to])))


def _distance(a: Point, b: Point) -> float:
    return hypot(b[0] - a[0], b[1] - a[1])
