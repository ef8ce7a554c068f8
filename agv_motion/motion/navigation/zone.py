"""Where the tree may go: a polygon with holes, a margin, and areas where it must not turn.

The platform turns as its sap flows, so its outline is the disc of its rim. The centre keeps the rim
and the margin away from every edge; then no part of the platform leaves the floor, and none comes
nearer to an edge than the margin.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

import shapely
from shapely import Polygon

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.corners import inset
from agv_motion.motion.navigation.polyline import ROUNDING
from agv_motion.planar import FARTHEST

if TYPE_CHECKING:
    from collections.abc import Sequence

    Ring = Sequence[Sequence[float]]

MARGIN = 0.5
"""[m] between the rim of the platform and every edge.

The original installation counted it from the centre.
"""


class Zone:
    """One zone; immutable."""

    def __init__(  # noqa: PLR0913 - a drawing, each with its own name
        self,
        boundary: Ring,
        holes: Sequence[Ring] = (),
        translation_only: Sequence[Ring] = (),
        margin: float = MARGIN,
        home: Sequence[float] | None = None,
        *,
        rim: float = 0.0,
    ) -> None:
        """Check the geometry and take the margin off.

        Args:
            boundary: (n, 2) outer edge in the map [m].
            holes: Edges of what stands within: a bench, a pond.
            translation_only: Edges of delicate floor, where turning is not allowed.
            margin: Distance that the rim of the platform keeps from every edge [m].
            home: Where the tree is parked, x and y in the map [m]; None: anywhere.
            rim: How far the platform reaches from its centre [m]; 0: the margin counts from the
                centre, and what hangs over an edge is nobody's concern.

        Raises:
            GeometryError: An edge is no polygon, a hole lies outside or overlaps another, an area
                touches nothing, the margin leaves nothing, or home is not reachable ground.

        """
        if not (isfinite(margin) and margin >= 0.0):
            msg = f'margin = {margin} m: must be zero or more, and finite'
            raise GeometryError(msg)
        if not (isfinite(rim) and rim >= 0.0):
            msg = f'rim = {rim} m: must be zero or more, and finite'
            raise GeometryError(msg)
        self.margin, self.rim = margin, rim
        self.boundary = outer = _polygon('boundary', boundary)
        self.holes = [_polygon(f'hole {i + 1}', hole) for i, hole in enumerate(holes)]
        self._check_holes(outer)
        self.floor: Polygon = outer.difference(shapely.union_all(self.holes))
        self.translation_only = [
            _polygon(f'translation-only area {i + 1}', area)
            for i, area in enumerate(translation_only)
        ]
        self._check_areas()
        self.parts = self._take_off(self.clearance)
        self._walkable = shapely.union_all(self.parts)
        self._delicate = shapely.union_all(self.translation_only)
        self._edges = self.floor.boundary
        for geometry in (self._walkable, self._delicate, self.floor, self._edges):
            shapely.prepare(geometry)
        self.home = None if home is None else _point('home', home)
        if self.home is not None and not self.walkable(*self.home):
            msg = f'home {self.home}: {self.why_not(*self.home)}; move it onto free floor'
            raise GeometryError(msg)
        if self.home is not None and self.part_of(*self.home) is not self.parts[0]:
            msg = (
                f'home {self.home} cannot be reached from the largest part of the zone '
                f'({self.parts[0].area:.1f} m2): move it there, or take less than '
                f'{margin:g} m of margin{self._from_rim}'
            )
            raise GeometryError(msg)

    def _check_areas(self) -> None:
        for i, area in enumerate(self.translation_only):
            if not area.intersects(self.floor):
                msg = f'translation-only area {i + 1} touches no floor: check its coordinates'
                raise GeometryError(msg)

    def _check_holes(self, outer: Polygon) -> None:
        for i, hole in enumerate(self.holes):
            if not outer.intersects(hole):
                msg = f'hole {i + 1} lies outside the boundary: remove it or move it in'
                raise GeometryError(msg)
            for k, other in enumerate(self.holes[:i]):
                if hole.intersection(other).area > 0.0:
                    msg = f'holes {k + 1} and {i + 1} overlap: draw them as one'
                    raise GeometryError(msg)

    @property
    def clearance(self) -> float:
        """Distance that the centre of the platform keeps from every edge [m]."""
        return self.margin + self.rim

    @property
    def _from_rim(self) -> str:
        return f' beside the rim of {self.rim:g} m' if self.rim else ''

    def _take_off(self, clearance: float) -> list[Polygon]:
        """Return the parts of the floor that remain within the clearance, the largest first."""
        if self.floor.is_empty:
            msg = 'the holes cover the whole zone: nothing is left to walk on'
            raise GeometryError(msg)
        left = shapely.get_parts(inset(self.floor, clearance))
        parts = [p for p in left if isinstance(p, Polygon) and not p.is_empty]
        if not parts:
            msg = (
                f'margin = {self.margin} m{self._from_rim} leaves nothing of the zone: widen it or '
                'take less margin'
            )
            raise GeometryError(msg)
        return sorted(parts, key=lambda part: -part.area)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest x and y, largest x and y of the floor [m]."""
        west, south, east, north = self.floor.bounds
        return west, south, east, north

    @property
    def area(self) -> float:
        """Of the floor [m2], holes taken off."""
        return float(self.floor.area)

    def contains(self, x: float, y: float) -> bool:
        """Return whether (x, y) [m] lies on the floor, edges included."""
        return bool(shapely.intersects_xy(self.floor, x, y))

    def holds(self, x: float, y: float) -> bool:
        """Return whether the whole platform, its rim included, lies on the floor at (x, y) [m]."""
        if self.walkable(x, y):
            return True  # and the margin beside it is free, too
        return self.contains(x, y) and self.edge_distance(x, y) >= self.rim - ROUNDING

    def edge_distance(self, x: float, y: float) -> float:
        """Return how far (x, y) [m] lies from the nearest edge [m]."""
        return float(shapely.distance(self._edges, shapely.Point(x, y)))

    def walkable(self, x: float, y: float) -> bool:
        """Return whether the centre of the platform may be at (x, y) [m]."""
        return bool(shapely.intersects_xy(self._walkable, x, y))

    def may_turn(self, x: float, y: float, radius: float = 0.0) -> bool:
        """Tell whether a platform of ``radius`` [m] may turn at (x, y) [m], off delicate floor."""
        if not self.translation_only:
            return True
        if radius == 0.0:
            return not shapely.intersects_xy(self._delicate, x, y)
        return not shapely.dwithin(self._delicate, shapely.Point(x, y), radius)

    def part_of(self, x: float, y: float) -> Polygon | None:
        """Return the walkable part in which (x, y) [m] lies, None where it lies in none."""
        return next((p for p in self.parts if shapely.intersects_xy(p, x, y)), None)

    def way_back(self, x: float, y: float) -> tuple[float, float]:
        """Return the walkable point to which the platform can go straight from (x, y) [m].

        Raises:
            GeometryError: A hole or an edge lies between.

        """
        here = shapely.Point(x, y)
        lines = [shapely.shortest_line(here, part) for part in self.parts]
        for line in sorted(lines, key=lambda line: float(line.length)):
            if self.contains(x, y):
                free = self.floor.buffer(ROUNDING).covers(line)
            else:
                free = not any(h.intersects(line) for h in self.holes if not h.intersects(here))
            if free:
                point = line.coords[-1]
                return point[0], point[1]
        msg = f'({x:.2f}, {y:.2f}) {self.why_not(x, y)}, and no straight way leads back'
        raise GeometryError(msg)

    def why_not(self, x: float, y: float) -> str:
        """Return in words why the platform may not be at (x, y)."""
        for i, hole in enumerate(self.holes):
            if shapely.intersects_xy(hole, x, y):
                return f'lies in hole {i + 1}'
        if not self.contains(x, y):
            west, south, east, north = self.bounds
            return (
                f'lies outside the zone (x from {west:g} to {east:g} m, '
                f'y from {south:g} to {north:g} m)'
            )
        over = self.rim - self.edge_distance(x, y)
        if over > 0.0:
            return f'has the rim {over:.2f} m over an edge'
        return f'lies nearer than the margin of {self.margin:g} m{self._from_rim} to an edge'


def _point(name: str, values: Sequence[float]) -> tuple[float, float]:
    """Return ``values`` as x and y.

    Raises:
        GeometryError: They are not two finite numbers.

    """
    try:
        x, y = map(float, values)
    except (TypeError, ValueError):
        x = y = float('nan')
    if not (isfinite(x) and isfinite(y)):
        msg = f'{name} must be [x, y] in metres, got {values!r:.80}'
        raise GeometryError(msg)
    return x, y


def _polygon(name: str, ring: Ring) -> Polygon:
    """Return a ring as a polygon.

    Raises:
        GeometryError: It is none.

    """
    try:
        points = [(float(x), float(y)) for x, y in ring]
    except (TypeError, ValueError) as error:
        msg = f'{name} must be a list of [x, y] in metres, got {ring!r:.80}'
        raise GeometryError(msg) from error
    if not all(abs(x) <= FARTHEST and abs(y) <= FARTHEST for x, y in points):
        msg = (
            f'{name} holds a coordinate that is not finite, or further than {FARTHEST:g} m: '
            f'{points!r:.80}'
        )
        raise GeometryError(msg)
    if len(set(points)) < 3:
        msg = f'{name} has {len(set(points))} different corners: a polygon needs at least 3'
        raise GeometryError(msg)
    polygon = Polygon(points)
    if not polygon.is_valid:
        msg = f'{name} is no polygon: {shapely.is_valid_reason(polygon)}; order its corners'
        raise GeometryError(msg)
    return polygon
