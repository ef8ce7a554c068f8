"""The navigator of a tree that is alone: its path, planned when it must be, followed by corners."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, inf
from typing import TYPE_CHECKING

import shapely
from shapely import LineString

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.navigator import Guidance
from agv_motion.motion.navigation.polyline import cut, nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.motion.navigation.path_planner import PathPlanner
    from agv_motion.motion.navigation.polyline import Path, Point
    from agv_motion.motion.navigation.zone import Zone

CORNER_REACH = 0.3
"""[m] A corner of the path counts as reached from here: twice the noise of a position fix ..."""

CORNER_SLACK = 0.01
"""[m] ... unless skipping it would cut into the margin by more than this."""

PLAN_PERIOD = 1.0
"""[s] between two plans for a tree that is off its path."""

PLAN_LIFETIME = 60.0
"""[s] after which the path is planned anew in any case."""


class PathFollower:
    """Keeps the path to the goal, and the place of the tree on it."""

    patience = inf
    """[s] nobody else is there who could block it"""

    def __init__(self, planner: PathPlanner) -> None:
        """Have no goal yet."""
        self._planner = planner
        self._waypoints = Waypoints(planner.zone, CORNER_REACH, CORNER_SLACK)
        self._planned: tuple[float, Point] | None = None
        """when the path was planned [s], and to which goal"""
        self._path: Path = ()

    def navigate(
        self, goal: Point | None, here: Point, now: float, *, straight: bool = False
    ) -> Guidance:
        """Return the next corner of the path to ``goal``; see :meth:`Navigator.navigate`."""
        if goal is None:
            return Guidance()
        if straight:
            return Guidance(goal, (here, goal))
        try:
            path = here, *self._waypoints.ahead(here, self._path_to(goal, here, now))
        except GeometryError as error:
            return Guidance(failure=error)
        return Guidance(path[1], path)

    def rest(self, here: Point, now: float) -> None:
        """Do nothing: nobody needs to know."""

    def closed(self) -> None:
        """Return None: nobody takes any floor."""

    def _path_to(self, goal: Point, here: Point, now: float) -> Path:
        """Return the rest of the path to ``goal``, from the point nearest to ``here`` on.

        It is planned anew when the goal has changed, when the tree is off it, and now and then.

        Raises:
            GeometryError: There is none.

        """
        along = self._along(goal, here, now)
        if along is None:
            self._planned = None  # should there be none
            self._path = self._plan(here, goal)
            self._planned, along = (now, goal), 0.0
        self._path = cut(self._path, along)[1]
        return self._path

    def _along(self, goal: Point, here: Point, now: float) -> float | None:
        """Return how far along its path the tree is [m]; None where it needs another one."""
        if self._planned is None:
            return None
        planned_at, planned_for = self._planned
        age = now - planned_at
        if goal != planned_for or not 0.0 <= age < PLAN_LIFETIME:
            return None
        along, away = nearest(self._path, here)
        return None if age >= PLAN_PERIOD and away > CORNER_REACH else along

    def _plan(self, here: Point, goal: Point) -> Path:
        """Return the path; a small step back into the margins is made on the path, not before."""
        path = tuple(self._planner.path(here, goal))
        aside = hypot(path[1][0] - here[0], path[1][1] - here[1])
        keeps_start = aside > CORNER_REACH or self._planner.zone.walkable(*here)
        return path if keeps_start else path[1:]


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
