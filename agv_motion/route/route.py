"""A route: straight segments through waypoints, gone once or several times."""

from __future__ import annotations

from itertools import accumulate
from math import atan2, hypot, inf, pi
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import GeometryError
from agv_motion.planar import FARTHEST

if TYPE_CHECKING:
    from collections.abc import Sequence


MOST_WAYPOINTS = 20_000
"""Of a longer one a virtual point would have to look through too many segments in each cycle."""


class Point(NamedTuple):
    """A place in the frame of the route."""

    x: float
    """[m]"""
    y: float
    """[m]"""


class Segment(NamedTuple):
    """One straight stretch between two waypoints."""

    start: Point
    ux: float
    """x of its direction, of length 1"""
    uy: float
    """y of its direction"""
    length: float
    """[m]"""

    def at(self, way: float) -> Point:
        """Return the point ``way`` [m] after its start."""
        return Point(self.start.x + way * self.ux, self.start.y + way * self.uy)


class RoutePlace(NamedTuple):
    """A point of a route; whole numbers beside a distance, so that no lap costs a digit."""

    segment: int
    """counted over all laps, from 0"""
    way: float
    """[m] after the start of the segment"""


class Route:
    """Nothing in it changes. A route of several laps comes back to its first waypoint."""

    def __init__(self, points: Sequence[Sequence[float]], laps: int = 1) -> None:
        """Join ``points``; one that repeats the one before it is dropped.

        Args:
            points: (n, 2) waypoints [m].
            laps: How often to go round; 0 without end. With more than one lap the last waypoint is
                joined to the first, unless it lies there.

        Raises:
            GeometryError: A point is no finite pair, fewer than 2 points differ, there are too
                many, or a negative number of laps.

        """
        if len(points) > MOST_WAYPOINTS:
            msg = (
                f'a route of {len(points)} waypoints: at most {MOST_WAYPOINTS}; leave out those '
                'that lie on straight stretches, or send it in parts'
            )
            raise GeometryError(msg)
        waypoints = _distinct([_point(i, pair) for i, pair in enumerate(points)])
        if laps < 0:
            msg = f'laps = {laps}: give 1 or more, or 0 to go round without end'
            raise GeometryError(msg)
        if laps != 1 and waypoints[0] != waypoints[-1]:
            waypoints.append(waypoints[0])
        self.waypoints = tuple(waypoints)
        self.laps = laps
        self.segments = tuple(map(_segment, waypoints, waypoints[1:]))
        self._starts = tuple(accumulate((s.length for s in self.segments), initial=0.0))
        self._bends = [
            _bend(s, self.segments[(i + 1) % len(self.segments)])
            for i, s in enumerate(self.segments)
        ]

    @property
    def lap_length(self) -> float:
        """Length of one lap [m]."""
        return self._starts[-1]

    @property
    def length(self) -> float:
        """Length of all laps [m]; infinite without end."""
        return self.lap_length * self.laps if self.laps else inf

    @property
    def count(self) -> float:
        """Number of the segments of all laps; infinite without end."""
        return len(self.segments) * self.laps if self.laps else inf

    def segment(self, number: int) -> Segment:
        """Return segment ``number`` of all laps."""
        return self.segments[number % len(self.segments)]

    def point(self, place: RoutePlace) -> Point:
        """Return where ``place`` is."""
        return self.segment(place.segment).at(place.way)

    def way(self, place: RoutePlace) -> float:
        """Return the length of the route from its start to ``place`` [m]."""
        lap, segment = divmod(place.segment, len(self.segments))
        return lap * self.lap_length + self._starts[segment] + place.way

    def is_last(self, number: int) -> bool:
        """Return whether no segment follows on segment ``number``."""
        return number + 1 >= self.count

    def bend(self, number: int) -> float:
        """Return the angle alpha between segment ``number`` and the next [rad].

        pi is straight on, 0 a hairpin. Where no segment follows, pi: there is no bend.
        """
        return pi if self.is_last(number) else self._bends[number % len(self.segments)]


def _point(index: int, pair: Sequence[float]) -> Point:
    try:
        x, y = (float(number) for number in pair)
    except (TypeError, ValueError) as error:
        msg = f'waypoint {index + 1} is {pair!r}: give two numbers, x and y in metres'
        raise GeometryError(msg) from error
    if not abs(x) <= FARTHEST or not abs(y) <= FARTHEST:
        msg = f'waypoint {index + 1} is ({x:g}, {y:g}): must be finite, at most {FARTHEST:g} m off'
        raise GeometryError(msg)
    return Point(x, y)


def _distinct(points: list[Point]) -> list[Point]:
    kept = points[:1]
    for point in points[1:]:
        if hypot(point.x - kept[-1].x, point.y - kept[-1].y) > 0.0:
            kept.append(point)
    if len(kept) < 2:
        msg = f'a route of {len(points)} waypoints, {len(kept)} of them distinct: give 2 or more'
        raise GeometryError(msg)
    return kept


def _segment(start: Point, end: Point) -> Segment:
    length = hypot(end.x - start.x, end.y - start.y)
    return Segment(start, (end.x - start.x) / length, (end.y - start.y) / length, length)


def _bend(first: Segment, second: Segment) -> float:
    """Return the angle between two segments at their common waypoint, without its sign."""
    dot = first.ux * second.ux + first.uy * second.uy
    cross = first.ux * second.uy - first.uy * second.ux
    return pi - abs(atan2(cross, dot))
