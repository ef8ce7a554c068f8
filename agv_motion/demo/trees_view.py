"""Several trees as they walk, in the terminal: the zone, their trails and goals, what each does."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING

from rich.console import Group

from agv_motion.demo.map_view import NUMBERS, MapView, Room
from agv_motion.demo.readout import NOT_YET, lines, number, pace, paragraphs, pose_text
from agv_motion.ros.messages import pose_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.console import RenderableType

    from agv_motion.demo.recorder import DemoRecorder
    from agv_motion.demo.zone_map import Mark
    from agv_motion.motion.navigation.zone import Zone

COLOURS = ('green', 'magenta', 'cyan', 'yellow', 'blue')

WITH_SAP = 6
"""Lines for each tree from which there is room for its sap flow beside what it does"""


class TreesView:
    """Draws what the recorder has heard."""

    def __init__(self, recorder: DemoRecorder, zone: Zone, names: Sequence[str]) -> None:
        """Start with empty trails of the trees ``names``."""
        self._recorder, self._view, self._names = recorder, MapView(zone), names
        self._trails: list[tuple[float, float, str]] = []

    def draw(self, now: float, factor: float, room: Room) -> RenderableType:
        """Return the picture at simulated ``now`` [s], passing ``factor`` times real time."""
        self._view.fit(room)
        cell_of, latest = self._view.map.cell_of, self._recorder.latest
        marks: dict[tuple[int, int], Mark] = {}
        for name, colour in zip(self._names, COLOURS, strict=False):
            truth, goal = latest(f'{name}/ground_truth'), latest(f'{name}/goal')
            if goal is not None:
                marks[cell_of(goal.pose.position.x, goal.pose.position.y)] = ('✕', colour)
            if truth is not None:
                here = truth.pose.pose.position
                self._trails.append((here.x, here.y, colour))
                marks[cell_of(here.x, here.y)] = ('♣', f'bold {colour}')
        trails = {cell_of(x, y): ('•', colour) for x, y, colour in self._trails}
        moment = datetime.fromtimestamp(now, timezone.utc)
        walks = self._view.map.text(trails | marks)
        told = Group(lines([('pace', pace(factor))], NUMBERS), *self._told(room.rows - 1))
        return self._view.picture(f'{moment:%H:%M:%S} UTC', walks, told)

    def _told(self, rows: int) -> Iterator[RenderableType]:
        """Yield what stands beside the map of each tree, in so many ``rows`` together."""
        shown = list(zip(self._names, COLOURS, strict=False))
        with_sap = rows >= WITH_SAP * len(shown)
        states = [self._recorder.latest(f'{name}/state') for name, _ in shown]
        doing = paragraphs(
            [NOT_YET if state is None else state.data for state in states],
            NUMBERS, rows - (1 + with_sap) * len(shown),
        )  # fmt: skip
        for (name, colour), does in zip(shown, doing, strict=True):
            numbers = lines(self._numbers(name)[: 1 + with_sap], NUMBERS)
            numbers.columns[0].style = colour
            yield from (numbers, does)

    def _numbers(self, name: str) -> list[tuple[str, str]]:
        """Return where one tree is, and its sap flow."""
        latest = self._recorder.latest
        truth = latest(f'{name}/ground_truth')
        flow = latest(f'{name}/granier/sap_flow')
        flows = flow and ' '.join(number(n, 4, 2) for n in (flow.vector.x, flow.vector.y,
                                                             flow.vector.z))  # fmt: skip
        return [
            (name, NOT_YET if truth is None else pose_text(pose_of(truth.pose.pose))),
            ('sap', flows or NOT_YET),
        ]
