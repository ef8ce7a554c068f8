"""A zone as characters in the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.text import Text

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.motion.navigation.zone import Zone

WIDTH, HEIGHT = 56, 20

OUTSIDE = '#'

Mark = tuple[str, str]
"""A character, and its style"""


class ZoneMap:
    """A picture of a zone, north up, `HEIGHT` rows of `WIDTH` characters."""

    def __init__(self, zone: Zone) -> None:
        """Draw ``zone``."""
        self._west, self._south, self._east, self._north = zone.bounds
        self._inside = {
            (row, column): zone.contains(*self.place_of(row, column))
            for row in range(HEIGHT)
            for column in range(WIDTH)
        }

    def cell_of(self, x: float, y: float) -> tuple[int, int]:
        """Return row and column of the picture at (x, y) [m]."""
        column = int((x - self._west) / (self._east - self._west) * (WIDTH - 1) + 0.5)
        row = int((self._north - y) / (self._north - self._south) * (HEIGHT - 1) + 0.5)
        return row, column

    def place_of(self, row: int, column: int) -> tuple[float, float]:
        """Return (x, y) [m] of a cell of the picture."""
        x = self._west + column * (self._east - self._west) / (WIDTH - 1)
        y = self._north - row * (self._north - self._south) / (HEIGHT - 1)
        return x, y

    def text(
        self,
        marks: Mapping[tuple[int, int], Mark],
        floor: Callable[[float, float], str] = lambda *_: ' ',
    ) -> Text:
        """Return the picture.

        Args:
            marks: What stands in a cell, by row and column.
            floor: Character of the bare floor at (x, y) [m].

        """
        text = Text()
        for (row, column), inside in self._inside.items():
            bare = floor(*self.place_of(row, column)) if inside else OUTSIDE
            text.append(*marks.get((row, column), (bare, 'dim')))
            if column == WIDTH - 1:
                text.append('\n')
        return text
