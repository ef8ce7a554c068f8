"""The way that the tree is on: looked for when it must be, followed from corner to corner."""

from __future__ import annotations

from math import hypot, inf
from typing import TYPE_CHECKING

from agv_motion.errors import GeometryError
from agv_motion.motion.paths import Paths, Waypoints, length

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.paths import Point
    from agv_motion.motion.zone import Zone

PLAN_PERIOD = 1.0
"""[s] between two looks for the way of a tree that is off it."""

PLAN_LIFETIME = 60.0
"""[s] after which the way is looked for anew in any case."""

OFF_COURSE = 0.05
"""[m] from the line to the next corner: the way from here is another."""


class Course:
    """The way to the goal, looked for now and then; and the ways that others leave free."""

    def __init__(self, zone: Zone, corner_reach: float, corner_slack: float) -> None:
        """Make the graph of all ways; see :class:`Waypoints` for the other two."""
        self._all = Paths(zone)
        self._taken: shapely.Geometry | None = None
        self._free = self._all
        self._waypoints = Waypoints(zone, corner_reach, corner_slack)
        self._planned_at, self._planned_for = -inf, ((0.0, 0.0), self._all)
        self._from: Point = (0.0, 0.0)
        self._rest: tuple[Point, ...] = ()

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
        if (
            wanted != self._planned_for
            or not 0.0 <= age < PLAN_LIFETIME
            or (age >= PLAN_PERIOD and _off(here, self._from, self._rest[0]) > OFF_COURSE)
        ):
            self._planned_at = -inf
            self._from, self._rest = here, tuple(wanted[1].way(here, goal)[1:])
            self._planned_at, self._planned_for = time, wanted
        reached = self._waypoints.reached(here, self._rest)
        if reached:
            self._from, self._rest = here, self._rest[reached:]
        return (here, *self._rest)

    def distance(self, here: Point, goal: Point) -> float:
        """Return the length of the way to ``goal`` past nobody [m]; 0 if there is none."""
        try:
            return length(self._all.way(here, goal))
        except GeometryError:
            return 0.0


def _off(here: Point, start: Point, end: Point) -> float:
    """Return how far ``here`` is from the straight line from ``start`` to ``end`` [m]."""
    x, y = end[0] - start[0], end[1] - start[1]
    squared = x * x + y * y
    along = (here[0] - start[0]) * x + (here[1] - start[1]) * y
    share = min(max(along / squared, 0.0), 1.0) if squared > 0.0 else 0.0
    return hypot(here[0] - start[0] - share * x, here[1] - start[1] - share * y)
