"""Several trees as they walk, in the terminal: the zone, their trails and goals, what each does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.columns import Columns
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from agv_motion.demo.tree_view import HEIGHT, WIDTH, cell_of, place_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import RenderableType

    from agv_motion.demo.recorder import DemoRecorder
    from agv_motion.motion.navigation.zone import Zone

COLOURS = ('green', 'magenta', 'cyan', 'yellow', 'blue')


class TreesView:
    """Draws what the recorder has heard."""

    def __init__(self, recorder: DemoRecorder, zone: Zone, names: Sequence[str]) -> None:
        """Start with empty trails of the trees ``names``."""
        self._recorder, self._zone, self._names = recorder, zone, names
        self._marks: dict[tuple[int, int], tuple[str, str]] = {}
        for row in range(HEIGHT):
            for column in range(WIDTH):
                if not zone.contains(*place_of(zone, row, column)):
                    self._marks[row, column] = ('#', 'dim')

    def draw(self) -> RenderableType:
        """Return the picture."""
        marks, does = {}, Table(box=None, show_header=False, pad_edge=False)
        for name, colour in zip(self._names, COLOURS, strict=False):
            truth = self._recorder.latest(f'{name}/ground_truth')
            goal = self._recorder.latest(f'{name}/goal')
            state = self._recorder.latest(f'{name}/state')
            if goal is not None:
                place = goal.pose.position
                marks[cell_of(self._zone, place.x, place.y)] = ('✕', colour)
            if truth is not None:
                place = truth.pose.pose.position
                here = cell_of(self._zone, place.x, place.y)
                self._marks[here] = ('•', colour)
                marks[here] = ('♣', f'bold {colour}')
            does.add_row(Text(name, colour), '' if state is None else state.data)
        text = Text()
        for row in range(HEIGHT):
            for column in range(WIDTH):
                at = row, column
                text.append(*marks.get(at, self._marks.get(at, (' ', ''))))
            text.append('\n')
        return Columns([Panel(text), does])
