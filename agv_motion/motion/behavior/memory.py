"""What the tree remembers of places: the sap flow it felt in each, and when it was last there.

A grid over the zone. Sap flow is felt where the trunk stands, in one cell; a cell is visited when
the platform stands over its centre, so a visit reaches as far as the platform does. Cells where
the trunk cannot be (holes, the margin, outside) hold nothing and are never goals.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from math import ceil, floor
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
import shapely

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.motion.navigation.zone import Zone

    Map = NDArray[np.float64]
    Mask = NDArray[np.bool_]

NEVER = -np.inf
"""[s] the time of what has not happened."""

LARGEST = 4_000_000
"""Cells beyond which a grid is a mistake: a square of 500 m at 0.25 m."""

CLOCK_STEP = 1.0
"""[s] A clock that falls back by more was set anew: what is remembered keeps its age."""


@dataclass(frozen=True)
class MemoryParameters:
    """How finely and how long the tree remembers."""

    cell: Annotated[float, Spec('edge of a cell of the two maps', 'm', (0.05, 10.0))] = 0.25
    reach: Annotated[
        float,
        Spec(
            'distance from the trunk within which cells count as visited; 0: under the platform',
            'm',
            (0, 100),
        ),
    ] = 0.0
    half_life: Annotated[
        float,
        Spec(
            'time in which half of the remembered sap flow fades to the mean of all; 0: never',
            'h',
            (0.0, 1e5),
        ),
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row, and that a visit reaches the cell it takes place in."""
        check(self)
        if 0.0 < self.reach < self.cell:
            msg = (
                f'memory.reach = {self.reach} m is less than memory.cell = {self.cell} m: '
                'take smaller cells'
            )
            raise ConfigurationError(msg)


class Grid(NamedTuple):
    """The three maps of a memory and where they lie: what is kept over a restart."""

    west: float
    """[m] x of the edge of column 0"""
    south: float
    """[m] y of the edge of row 0"""
    cell: float
    """[m]"""
    flow: Map
    """(rows, columns) s3 last felt, NaN where never"""
    felt_at: Map
    """(rows, columns) when [s], `NEVER` where never"""
    visited_at: Map
    """(rows, columns) when the platform last stood over the cell [s]"""
    zone: str
    """digest of the zone they belong to"""


class Memory:
    """Two maps of one zone, and the time of what the first holds."""

    def __init__(
        self,
        zone: Zone,
        parameters: MemoryParameters | None = None,
        rim: float = PLATFORM_RADIUS,
    ) -> None:
        """Remember nothing yet.

        Args:
            zone: Where the tree walks.
            parameters: Size of the cells and so on.
            rim: How far the platform reaches from its centre [m].

        Raises:
            GeometryError: The cells are so small that there are too many, or so large that the
                trunk can stand in the centre of none.

        """
        self.parameters = given = parameters or MemoryParameters()
        self.reach = given.reach or max(rim, given.cell)
        """Cells so near to the trunk are visited [m]."""
        self.west, self.south, east, north = zone.bounds
        columns = ceil((east - self.west) / given.cell - 1e-9)
        rows = ceil((north - self.south) / given.cell - 1e-9)
        if rows * columns > LARGEST:
            msg = f'memory.cell = {given.cell} m makes {rows} x {columns} cells: take larger ones'
            raise GeometryError(msg)
        self.x: Map = self.west + given.cell * (np.arange(columns, dtype=np.float64) + 0.5)
        """(columns,) centres of the cells [m]"""
        self.y: Map = self.south + given.cell * (np.arange(rows, dtype=np.float64) + 0.5)
        """(rows,) centres of the cells [m]"""
        x, y = np.meshgrid(self.x, self.y)
        self.part = np.full((rows, columns), -1)
        """(rows, columns) which walkable part of the zone a cell lies in; -1: in none"""
        for i, part in enumerate(zone.parts):
            self.part[shapely.intersects_xy(part, x, y)] = i
        self.walkable: Mask = self.part >= 0
        if not self.walkable.any():
            msg = f'memory.cell = {given.cell} m: no cell fits into the zone; take smaller ones'
            raise GeometryError(msg)
        self.flow: Map = np.full((rows, columns), np.nan)
        self.felt_at: Map = np.full((rows, columns), NEVER)
        self.visited_at: Map = np.full((rows, columns), NEVER)
        self.newest = NEVER
        """Time of the latest of what is remembered [s]."""
        self._parts = np.array(zone.parts)
        self._zone = _digest(zone)
        self._stood: tuple[float, float] | None = None
        self._here: tuple[int, int] | None = None
        self._under: tuple[Map, Mask] = self.visited_at[:0], self.walkable[:0]

    def cell_of(self, x: float, y: float) -> tuple[int, int] | None:
        """Return row and column of a point [m]; None where the trunk cannot be."""
        row = floor((y - self.south) / self.parameters.cell)
        column = floor((x - self.west) / self.parameters.cell)
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

    def update(self, time: float, x: float, y: float, flow: float) -> None:
        """Write down that the tree stands at (x, y) [m] at ``time`` [s] and feels ``flow``."""
        if time < self.newest - CLOCK_STEP:
            self._set_back(self.newest - time)
        self.newest = max(time, self.newest)
        if (x, y) != self._stood:
            self._stood, self._here, self._under = (x, y), self.cell_of(x, y), self._visited(x, y)
        if self._here is not None:
            self.flow[self._here], self.felt_at[self._here] = flow, time
        window, under = self._under
        window[under] = time

    def remembered(self, time: float) -> Map:
        """Return the sap flow of each cell as it is remembered at ``time`` [s]; NaN where never.

        With a half-life, what was felt fades towards the mean of all cells, so that an old high
        gives way to a fresh one and is still known.
        """
        half_life = self.parameters.half_life * 3600.0
        if half_life == 0.0 or not self.felt.any():
            return self.flow.copy()
        mean = np.nanmean(self.flow)
        weight = 0.5 ** (np.maximum(time - self.felt_at, 0.0) / half_life)
        return mean + weight * (self.flow - mean)

    @property
    def felt(self) -> Mask:
        """(rows, columns) where sap flow has ever been felt."""
        return np.isfinite(self.flow)

    @property
    def visited(self) -> Mask:
        """(rows, columns) where the platform has ever stood."""
        return self.visited_at > NEVER

    def coverage(self, part: int = 0) -> tuple[float, float]:
        """Return the shares of the cells of a walkable part that were visited, and felt."""
        cells = self.part == part
        return float(self.visited[cells].mean()), float(self.felt[cells].mean())

    def grid(self) -> Grid:
        """Return a copy of all that is remembered."""
        maps = self.flow.copy(), self.felt_at.copy(), self.visited_at.copy()
        return Grid(self.west, self.south, self.parameters.cell, *maps, self._zone)

    def recall(self, grid: Grid) -> bool:
        """Take up what was kept; return whether it belongs to this very zone and these cells.

        What belongs to another is carried over place by place, as far as the two overlap: a bench
        that was moved does not cost a season.
        """
        own = (grid.west, grid.south, grid.cell, grid.zone)
        same = own == (self.west, self.south, self.parameters.cell, self._zone)
        rows = np.floor((self.y - grid.south) / grid.cell).astype(int)
        columns = np.floor((self.x - grid.west) / grid.cell).astype(int)
        inside = (
            ((rows >= 0) & (rows < grid.flow.shape[0]))[:, None]
            & ((columns >= 0) & (columns < grid.flow.shape[1]))[None, :]
            & self.walkable
        )
        row, column = np.nonzero(inside)
        source = rows[row], columns[column]
        self.flow[inside] = grid.flow[source]
        self.felt_at[inside] = grid.felt_at[source]
        self.visited_at[inside] = grid.visited_at[source]
        self.newest = float(max(self.felt_at.max(), self.visited_at.max()))
        return same

    def _visited(self, x: float, y: float) -> tuple[Map, Mask]:
        """Return the part of `visited_at` about (x, y) [m], and what of it the platform visits."""
        rows, columns = self._near(y - self.south), self._near(x - self.west)
        away = (self.y[rows, None] - y) ** 2 + (self.x[columns] - x) ** 2
        under = (away <= self.reach**2) & self.walkable[rows, columns]
        return self.visited_at[rows, columns], under

    def _near(self, distance: float) -> slice:
        """Return the rows (or columns) within reach of a distance from the edge of the first."""
        cell, reach = self.parameters.cell, self.reach
        first = ceil((distance - reach) / cell - 0.5)
        return slice(max(first, 0), max(floor((distance + reach) / cell + 0.5), 0))

    def _set_back(self, seconds: float) -> None:
        """Move all times back with the clock: order and age stay."""
        self.felt_at -= seconds
        self.visited_at -= seconds
        self.newest -= seconds


def _digest(zone: Zone) -> str:
    """Return a short name of the walkable floor, the same for the same floor."""
    parts = b''.join(shapely.to_wkb(part.normalize()) for part in zone.parts)
    return hashlib.sha256(parts).hexdigest()[:16]
