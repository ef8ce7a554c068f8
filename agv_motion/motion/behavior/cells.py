"""A grid over a zone: in which cells the trunk can be, and in which part of the zone."""

from __future__ import annotations

from math import ceil, floor
from typing import TYPE_CHECKING

import numpy as np
import shapely

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.motion.navigation.zone import Zone

    Map = NDArray[np.float64]
    Mask = NDArray[np.bool_]

LARGEST = 4_000_000
"""Cells beyond which a grid is a mistake: a square of 500 m at 0.25 m."""


class ZoneCells:
    """The cells of one zone."""

    def __init__(self, zone: Zone, size: float) -> None:
        """Lay the grid, from the south-western corner of the zone.

        Args:
            zone: Where the tree walks.
            size: Edge of a cell [m].

        Raises:
            GeometryError: The cells are so small that there are too many, or so large that the
                trunk can stand in the centre of none.

        """
        self.size = size
        west, south, east, north = zone.bounds
        self.corner = west, south
        """[m] where row 0 and column 0 begin"""
        columns = ceil((east - west) / size - 1e-9)
        rows = ceil((north - south) / size - 1e-9)
        if rows * columns > LARGEST:
            msg = f'memory.cell = {size} m makes {rows} x {columns} cells: take larger ones'
            raise GeometryError(msg)
        self.x: Map = west + size * (np.arange(columns, dtype=np.float64) + 0.5)
        """(columns,) centres of the cells [m]"""
        self.y: Map = south + size * (np.arange(rows, dtype=np.float64) + 0.5)
        """(rows,) centres of the cells [m]"""
        x, y = np.meshgrid(self.x, self.y)
        self.part = np.full((rows, columns), -1)
        """(rows, columns) which walkable part of the zone a cell lies in; -1: in none"""
        for i, part in enumerate(zone.parts):
            self.part[shapely.intersects_xy(part, x, y)] = i
        self.walkable: Mask = self.part >= 0
        if not self.walkable.any():
            msg = f'memory.cell = {size} m: no cell fits into the zone; take smaller ones'
            raise GeometryError(msg)
        self._parts = np.array(zone.parts)

    def cell_of(self, x: float, y: float) -> tuple[int, int] | None:
        """Return row and column of a point [m]; None where the trunk cannot be."""
        west, south = self.corner
        row, column = floor((y - south) / self.size), floor((x - west) / self.size)
        rows, columns = self.part.shape
        if 0 <= row < rows and 0 <= column < columns and self.walkable[row, column]:
            return row, column
        return None

    def part_at(self, x: float, y: float) -> int:
        """Return the walkable part of the zone in which, or nearest to which, a point lies [m]."""
        here = self.cell_of(x, y)
        if here is not None:
            return int(self.part[here])
        return int(shapely.distance(self._parts, shapely.Point(x, y)).argmin())

    def within(self, x: float, y: float, reach: float) -> tuple[tuple[slice, slice], Mask]:
        """Return a window of cells about a point [m], and which of them are walkable and within.

        Args:
            x: Of the point [m].
            y: Of the point [m].
            reach: Of the centres of the cells from the point [m].

        """
        west, south = self.corner
        window = self._near(y - south, reach), self._near(x - west, reach)
        away = (self.y[window[0], None] - y) ** 2 + (self.x[window[1]] - x) ** 2
        return window, (away <= reach**2) & self.walkable[window]

    def _near(self, distance: float, reach: float) -> slice:
        """Return the rows (or columns) within reach of a distance from the edge of the first."""
        first = ceil((distance - reach) / self.size - 0.5)
        return slice(max(first, 0), max(floor((distance + reach) / self.size + 0.5), 0))
