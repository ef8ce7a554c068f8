r"""The virtual point: what a robot on a route runs after, at a distance, so that it cuts corners.

With the robot at p, a segment from a in direction u, :math:`s_p = (p - a) \cdot u` and
:math:`h^2 = |p - a|^2 - s_p^2`, the circle of radius r about the robot leaves the segment at

.. math:: s = s_p + \sqrt{r^2 - h^2}

The point only goes forwards. While it lies in the circle it goes to where the route leaves the
circle next, or to the end of the route if it stays inside all the way there. When it lies outside,
either the robot fell away from it, or it jumped past: of all places where the route leaves the
circle, the one nearest to the point, along the route, tells which. Behind the point: it waits.
Ahead: it goes there. That the route *ends* in the circle says nothing then: a robot pushed near the
end would leave out all that lies between.
"""

from __future__ import annotations

from math import hypot, inf, sqrt
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError
from agv_motion.route.route import RoutePlace

if TYPE_CHECKING:
    from agv_motion.route.route import Point, Route


class VirtualPoint:
    """A place on a route that only moves forwards."""

    def __init__(self, route: Route, radius: float) -> None:
        """Start at the start of ``route``.

        Args:
            route: What it moves on.
            radius: dp, its distance from the robot [m], positive.

        Raises:
            ConfigurationError: As :meth:`set_radius`.

        """
        self._route = route
        self.place = RoutePlace(0, 0.0)
        self.set_radius(radius)

    def set_radius(self, radius: float) -> None:
        """Change dp [m].

        Raises:
            ConfigurationError: A route of several laps fits into the circle: the point could not
                tell one lap from the next.

        """
        xs, ys = zip(*self._route.waypoints, strict=True)
        width, height = max(xs) - min(xs), max(ys) - min(ys)
        if self._route.laps != 1 and hypot(width, height) <= 2.0 * radius:
            msg = (
                f'a lap of {width:.4g} m by {height:.4g} m fits into the circle of the virtual '
                f'point, of radius {radius:g} m: give a smaller distance or a larger route'
            )
            raise ConfigurationError(msg)
        self._radius = radius

    @property
    def point(self) -> Point:
        """Where it is."""
        return self._route.point(self.place)

    def advance(self, x: float, y: float) -> None:
        """Go where it has to be for a robot at (``x``, ``y``) [m]."""
        point = self.point
        if hypot(x - point.x, y - point.y) <= self._radius:
            self.place = self._next_exit(x, y)
            return
        back = self._distance_to_exit_behind(x, y)
        self.place = self._exit_ahead(x, y, back) or self.place

    def _next_exit(self, x: float, y: float) -> RoutePlace:
        """Return where the stretch of route inside the circle, from the point on, leaves it."""
        number, way = self.place
        for _ in self._route.segments:  # at most one lap: a circle may hold a whole one
            exit_way = self._exit_way(number, x, y)
            length = self._route.segment(number).length
            if exit_way <= length:
                return RoutePlace(number, max(exit_way, way))
            if self._route.is_last(number):
                return RoutePlace(number, length)
            number, way = number + 1, 0.0
        return self.place

    def _exit_ahead(self, x: float, y: float, within: float) -> RoutePlace | None:
        """Return the next exit ahead of the point, if it is nearer than ``within`` [m] of route."""
        number, way = self.place
        passed = -way
        for _ in range(len(self._route.segments) + 1):
            length = self._route.segment(number).length
            exit_way = self._exit_way(number, x, y)
            if way <= exit_way <= length:
                return RoutePlace(number, exit_way) if passed + exit_way < within else None
            passed += length
            if passed >= within or self._route.is_last(number):
                return None
            number, way = number + 1, 0.0
        return None

    def _distance_to_exit_behind(self, x: float, y: float) -> float:
        """Return how far back the route last leaves the circle [m]; infinite if nowhere."""
        number, way = self.place
        passed = way
        for _ in range(len(self._route.segments) + 1):
            exit_way = self._exit_way(number, x, y)
            if 0.0 <= exit_way <= way:
                return passed - exit_way
            if number == 0:
                break
            number -= 1
            way = self._route.segment(number).length
            passed += way
        return inf

    def _exit_way(self, number: int, x: float, y: float) -> float:
        """Return where the line of a segment leaves the circle [m]; -inf if it misses it."""
        segment = self._route.segment(number)
        dx, dy = x - segment.start.x, y - segment.start.y
        along = dx * segment.ux + dy * segment.uy
        across = dy * segment.ux - dx * segment.uy
        square = self._radius * self._radius - across * across
        return along + sqrt(square) if square > 0.0 else -inf
