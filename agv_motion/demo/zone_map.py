"""A zone as characters in the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.text import Text

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.motion.navigation.zone import Zone

WIDTH, HEIGHT = 46, 19
"""Of a picture in a terminal of 80 by 24, with room for numbers beside it [characters]"""

WIDEST = 110
"""Of a picture where there is more room"""

TALL = 2.0
"""How much taller than wide a character is"""

OUTSIDE = '#'

Mark = tuple[str, str]
"""A character, and its style"""


class ZoneMap:
    """A picture of a zone, north up."""

    def __init__(self, zone: Zone, width: int = WIDTH, height: int = HEIGHT) -> None:
        """Draw ``zone`` in its proportions into ``width`` columns and ``height`` rows, or fewer."""
        self._west, self._south, self._east, self._north = zone.bounds
        wide, high = self._east - self._west, self._north - self._south
        fit = min(width, WIDEST, round(height * TALL * wide / high))
        self.columns = max(fit, 2)
        self.rows = max(min(round(self.columns * high / wide / TALL), height), 2)
        self._inside = {
            (row, column): zone.contains(*self.place_of(row, column))
            for row in range(self.rows)
            for column in range(self.columns)
        }

    def cell_of(self, x: float, y: float) -> tuple[int, int]:
        """Return row and column of the picture at (x, y) [m]."""
        column = int((x - self._west) / (self._east - self._west) * (self.columns - 1) + 0.5)
        row = int((self._north - y) / (self._north - self._south) * (self.rows - 1) + 0.5)
        return row, column

    def place_of(self, row: int, column: int) -> tuple[float, float]:
        """Return (x, y) [m] of a cell of the picture."""
        x = self._west + column * (self._east - self._west) / (self.columns - 1)
        y = self._north - row * (self._north - self._south) / (self.rows - 1)
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
        text, run, style = Text(), '', ''  # as few runs of one style as there are: each costs bytes
        for (row, column), inside in self._inside.items():
            mark = marks.get((row, column))
            bare = floor(*self.place_of(row, column)) if inside else OUTSIDE
            character, wanted = mark or (bare, style if bare == ' ' else 'dim')
            if wanted != style:
                text.append(run, style)
                run, style = '', wanted
            run += character + '\n' * (column == self.columns - 1)
        return text.append(run.removesuffix('\n'), style)
