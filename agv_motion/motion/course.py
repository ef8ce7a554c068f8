"""The way that the tree is on: looked for when it must be, followed from corner to corner."""

from __future__ import annotations

from math import hypot, inf
from typing import TYPE_CHECKING

from agv_motion.errors import GeometryError
from agv_motion.motion.paths import Paths, Waypoints
from agv_motion.motion.polyline import cut, length, nearest

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.paths import Point
    from agv_motion.motion.zone import Zone

PLAN_PERIOD = 1.0
"""[s] between two looks for the way of a tree that is off it."""

PLAN_LIFETIME = 60.0
"""[s] after which the way is looked for anew in any case."""


class Course:
    """The way to the goal, looked for now and then; and the ways that others leave free."""

    def __init__(self, zone: Zone, corner_reach: float, corner_slack: float) -> None:
        """Make the graph of all ways; see :class:`Waypoints` for the other two."""
        self._zone, self._reach = zone, corner_reach
        self._all = Paths(zone)
        self._taken: shapely.Geometry | None = None
        self._free = self._all
        self._waypoints = Waypoints(zone, corner_reach, corner_slack)
        self._planned_at, self._planned_for = -inf, ((0.0, 0.0), self._all)
        self._way: tuple[Point, ...] = ((0.0, 0.0),)

    def free(self, avoid: shapely.Geometry | None = None) -> Paths:
        """Return the ways off what others need; worked out once for each area."""
        if avoid is not self._taken:
            self._taken = avoid
            self._free = self._all if self._taken is None else self._all.without(self._taken)
        return self._free

    def to(
        self, time: float, here: Point, goal: Point, avoid: shapely.Geometry | None = None
    ) -> tuple[Point, ...]:
        """Return the corners of the way to ``goal``, the first to head for after ``here``.

        It is looked for anew when the goal or what others leave free has changed, when the tree
        is off it, and now and then.

        Raises:
            GeometryError: There is none.

        """
        wanted = goal, self.free(avoid)
        age = time - self._planned_at
        along, away = nearest(self._way, here)
        if (
            wanted != self._planned_for
            or not 0.0 <= age < PLAN_LIFETIME
            or (age >= PLAN_PERIOD and away > self._reach)
        ):
            self._planned_at = -inf
            self._way = self._look(here, goal)
            self._planned_at, self._planned_for = time, wanted
            along = 0.0
        self._way = cut(self._way, along)[1]
        return (here, *self._waypoints.ahead(here, self._way))

    def _look(self, here: Point, goal: Point) -> tuple[Point, ...]:
        """Return the way; a small step back into the margins is made on the way, not before."""
        way = tuple(self._free.way(here, goal))
        aside = hypot(way[1][0] - here[0], way[1][1] - here[1])
        return way if aside > self._reach or self._zone.walkable(*here) else way[1:]

    def distance(self, here: Point, goal: Point) -> float:
        """Return the length of the way to ``goal`` past nobody [m]; 0 if there is none."""
        try:
            return length(self._all.way(here, goal))
        except GeometryError:
            return 0.0
