"""Several trees as they walk, in the terminal: the zone, their trails and goals, what each does."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING

from rich.columns import Columns
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from agv_motion.demo.zone_map import Mark, ZoneMap

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
        self._recorder, self._map, self._names = recorder, ZoneMap(zone), names
        self._trails: dict[tuple[int, int], Mark] = {}

    def draw(self, now: float, factor: float) -> RenderableType:
        """Return the picture at simulated ``now`` [s], passing ``factor`` times real time."""
        does = Table(box=None, show_header=False, pad_edge=False)
        marks: dict[tuple[int, int], Mark] = {}
        for name, colour in zip(self._names, COLOURS, strict=False):
            truth = self._recorder.latest(f'{name}/ground_truth')
            goal = self._recorder.latest(f'{name}/goal')
            state = self._recorder.latest(f'{name}/state')
            if goal is not None:
                place = goal.pose.position
                marks[self._map.cell_of(place.x, place.y)] = ('✕', colour)
            if truth is not None:
                place = truth.pose.pose.position
                here = self._map.cell_of(place.x, place.y)
                self._trails[here] = ('•', colour)
                marks[here] = ('♣', f'bold {colour}')
            does.add_row(Text(name, colour), '' if state is None else state.data)
        moment = datetime.fromtimestamp(now, timezone.utc)
        title = f'{moment:%H:%M:%S} UTC, {factor:.0f} times real time'
        return Columns([Panel(self._map.text(self._trails | marks), title=title), does])
