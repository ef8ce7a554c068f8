"""Several trees as they walk, in the terminal: the zone, their trails and goals, what each does."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING

from rich.console import Group

from agv_motion.demo.map_view import NUMBERS, MapView, Room
from agv_motion.demo.readout import NOT_YET, lines, number, pace, pose_text
from agv_motion.ros.messages import pose_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import RenderableType

    from agv_motion.demo.recorder import DemoRecorder
    from agv_motion.demo.zone_map import Mark
    from agv_motion.motion.navigation.zone import Zone

COLOURS = ('green', 'magenta', 'cyan', 'yellow', 'blue')


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
        told = [lines([('pace', pace(factor))], NUMBERS)]
        for name, colour in zip(self._names, COLOURS, strict=False):
            truth, goal = latest(f'{name}/ground_truth'), latest(f'{name}/goal')
            if goal is not None:
                marks[cell_of(goal.pose.position.x, goal.pose.position.y)] = ('✕', colour)
            if truth is not None:
                here = truth.pose.pose.position
                self._trails.append((here.x, here.y, colour))
                marks[cell_of(here.x, here.y)] = ('♣', f'bold {colour}')
            told.append(lines(self._numbers(name), NUMBERS, tall=4 if len(self._names) < 4 else 2))
            told[-1].columns[0].style = colour
        trails = {cell_of(x, y): ('•', colour) for x, y, colour in self._trails}
        moment = datetime.fromtimestamp(now, timezone.utc)
        walks = self._view.map.text(trails | marks)
        return self._view.picture(f'{moment:%H:%M:%S} UTC', walks, Group(*told))

    def _numbers(self, name: str) -> list[tuple[str, str]]:
        """Return what stands beside the map of one tree: three lines, or four."""
        latest = self._recorder.latest
        truth, state = latest(f'{name}/ground_truth'), latest(f'{name}/state')
        flow = latest(f'{name}/granier/sap_flow')
        flows = flow and ' '.join(number(n, 4, 2) for n in (flow.vector.x, flow.vector.y,
                                                             flow.vector.z))  # fmt: skip
        return [
            (name, NOT_YET if truth is None else pose_text(pose_of(truth.pose.pose))),
            ('sap', flows or NOT_YET),
            ('', NOT_YET if state is None else state.data),
        ]
