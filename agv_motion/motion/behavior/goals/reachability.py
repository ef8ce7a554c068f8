"""How goals are reached: by the shortest path, or only in a straight line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from agv_motion.motion.navigation.open_floor import OpenFloor
    from agv_motion.motion.navigation.polyline import Point


class Reachability(Protocol):
    """How goals are reached."""

    retry_distance: float
    """[m] how far from a goal without a path the next attempt of the same decision stays"""

    def require(self, floor: OpenFloor, start: Point, goal: Point) -> None:
        """Raise a `GeometryError` if ``goal`` cannot be reached from ``start`` [m]."""


class ShortestPath:
    """Round every corner: what is walkable and connected is reached."""

    retry_distance = 2.0

    def require(self, floor: OpenFloor, start: Point, goal: Point) -> None:
        """Make sure that any path leads there."""
        floor.path(start, goal)


class StraightLine:
    """As the original installation: straight or not at all; the next attempt may ask the same."""

    retry_distance = 0.0

    def require(self, floor: OpenFloor, start: Point, goal: Point) -> None:
        """Make sure that the straight line leads there.

        Raises:
            GeometryError: It leaves the walkable floor.

        """
        if not floor.is_straight(start, goal):
            msg = f'no straight line leads to ({goal[0]:.2f}, {goal[1]:.2f})'
            raise GeometryError(msg)
