"""What the tree remembers of places: the sap flow it felt in each, and when it was last there.

A grid over the zone. Sap flow is felt where the trunk stands, in one cell; a cell is visited when
the platform stands over its centre, so a visit reaches as far as the platform does. Cells where
the trunk cannot be (holes, the margin, outside) hold nothing and are never goals.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
import shapely

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.behavior.cells import ZoneCells
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from agv_motion.motion.behavior.cells import Map, Mask
    from agv_motion.motion.navigation.zone import Zone

NEVER = -np.inf
"""[s] the time of what has not happened."""

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
        self.cells = ZoneCells(zone, given.cell)
        shape = self.cells.part.shape
        self.flow: Map = np.full(shape, np.nan)
        self.felt_at: Map = np.full(shape, NEVER)
        self.visited_at: Map = np.full(shape, NEVER)
        self.newest = NEVER
        """Time of the latest of what is remembered [s]."""
        self._zone = _digest(zone)
        self._stood: tuple[float, float] | None = None
        self._here: tuple[int, int] | None = None
        self._under: tuple[Map, Mask] = self.visited_at[:0], self.cells.walkable[:0]

    def update(self, time: float, x: float, y: float, flow: float) -> None:
        """Write down that the tree stands at (x, y) [m] at ``time`` [s] and feels ``flow``."""
        if time < self.newest - CLOCK_STEP:
            self._set_back(self.newest - time)
        self.newest = max(time, self.newest)
        if (x, y) != self._stood:
            self._stood, self._here = (x, y), self.cells.cell_of(x, y)
            where, under = self.cells.within(x, y, self.reach)
            self._under = self.visited_at[where], under
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
        cells = self.cells.part == part
        return float(self.visited[cells].mean()), float(self.felt[cells].mean())

    def grid(self) -> Grid:
        """Return a copy of all that is remembered."""
        maps = self.flow.copy(), self.felt_at.copy(), self.visited_at.copy()
        return Grid(*self.cells.corner, self.cells.size, *maps, self._zone)

    def recall(self, grid: Grid) -> bool:
        """Take up what was kept; return whether it belongs to this very zone and these cells.

        What belongs to another is carried over place by place, as far as the two overlap: a bench
        that was moved does not cost a season.
        """
        cells = self.cells
        kept = (grid.west, grid.south), grid.cell, grid.zone
        same = kept == (cells.corner, cells.size, self._zone)
        rows = np.floor((cells.y - grid.south) / grid.cell).astype(int)
        columns = np.floor((cells.x - grid.west) / grid.cell).astype(int)
        inside = (
            ((rows >= 0) & (rows < grid.flow.shape[0]))[:, None]
            & ((columns >= 0) & (columns < grid.flow.shape[1]))[None, :]
            & cells.walkable
        )
        row, column = np.nonzero(inside)
        source = rows[row], columns[column]
        self.flow[inside] = grid.flow[source]
        self.felt_at[inside] = grid.felt_at[source]
        self.visited_at[inside] = grid.visited_at[source]
        self.newest = float(max(self.felt_at.max(), self.visited_at.max()))
        return same

    def _set_back(self, seconds: float) -> None:
        """Move all times back with the clock: order and age stay."""
        self.felt_at -= seconds
        self.visited_at -= seconds
        self.newest -= seconds


def _digest(zone: Zone) -> str:
    """Return a short name of the walkable floor, the same for the same floor."""
    parts = b''.join(shapely.to_wkb(part.normalize()) for part in zone.parts)
    return hashlib.sha256(parts).hexdigest()[:16]
