"""The map of a demo with numbers beside it, as large as the terminal allows: made for 80 by 24."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from rich.panel import Panel
from rich.table import Table

from agv_motion.demo.zone_map import ZoneMap

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.text import Text

    from agv_motion.motion.navigation.zone import Zone

NUMBERS = 29
"""Columns beside the map"""

FRAME = 4, 2
"""Columns and rows that the frame of the map takes"""


NARROWEST = 60
"""Columns of a terminal from which there is room for a map"""


class Room(NamedTuple):
    """What a picture may take of the terminal [characters]."""

    columns: int
    rows: int


class MapView:
    """Lays out a map and numbers; the map is made anew where the terminal has another size."""

    def __init__(self, zone: Zone) -> None:
        """Show ``zone``."""
        self._zone = zone
        self._room: Room | None = None
        self.map = ZoneMap(zone)

    def fit(self, room: Room) -> ZoneMap:
        """Return the map for so much room."""
        if room != self._room:
            self._room = room
            width, height = room.columns - NUMBERS - 1 - FRAME[0], room.rows - FRAME[1]
            self.map = ZoneMap(self._zone, max(width, 10), max(height, 4))
        return self.map

    def picture(self, title: str, walk: Text, numbers: RenderableType) -> RenderableType:
        """Return map and numbers beside each other; the numbers alone where it is narrow."""
        if self._room and self._room.columns < NARROWEST:
            return numbers
        whole = Table.grid(padding=(0, 1, 0, 0))
        whole.add_column(width=self.map.columns + FRAME[0], no_wrap=True)
        whole.add_column(width=NUMBERS, no_wrap=True)
        whole.add_row(Panel(walk, title=title, title_align='left'), numbers)
        return whole
