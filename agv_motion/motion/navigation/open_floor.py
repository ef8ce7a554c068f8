"""The floor that is open to goals: what may be walked on, less what others close for a while."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.navigation.path_planner import PathPlanner
    from agv_motion.motion.navigation.polyline import Point


class OpenFloor:
    """Paths to goals past what others close; planned for each such area once."""

    def __init__(self, planner: PathPlanner) -> None:
        """Begin with all the floor of the zone of ``planner``."""
        self._planner = self._open = planner
        self._closed: shapely.Geometry | None = None

    def close(self, area: shapely.Geometry | None) -> None:
        """Take ``area`` off, in place of what was closed before; None: take nothing off."""
        if area is not self._closed:
            self._closed = area
            self._open = self._planner if area is None else self._planner.without(area)

    def path(self, start: Point, goal: Point) -> list[Point]:
        """Return the corners of the shortest path; see :meth:`PathPlanner.path`."""
        return self._open.path(start, goal)

    def is_straight(self, start: Point, goal: Point) -> bool:
        """Return whether that path is one line; see :meth:`PathPlanner.is_straight`."""
        return self._open.is_straight(start, goal)
