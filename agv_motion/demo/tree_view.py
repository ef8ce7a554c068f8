"""The demo as it runs, in the terminal: the zone, the trail, the probes and the turrets."""

from __future__ import annotations

from datetime import datetime, timezone
from math import hypot, pi
from typing import TYPE_CHECKING

from rich.columns import Columns
from rich.panel import Panel
from rich.table import Table

from agv_motion.demo.zone_map import Mark, ZoneMap
from agv_motion.ros.messages import TurretJoints, pose_of
from agv_motion.simulation.shade import sunlit
from agv_motion.simulation.sun import sun

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.text import Text

    from agv_motion.demo.recorder import DemoRecorder
    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.nodes.simulator import SimulatorParameters
    from agv_motion.planar import Pose

ARROWS = '→↗↑↖←↙↓↘'


class TreeView:
    """Draws what the recorder has heard."""

    def __init__(self, recorder: DemoRecorder, zone: Zone, place: SimulatorParameters) -> None:
        """Start with an empty trail.

        Args:
            recorder: What has been heard.
            zone: To draw.
            place: Where the sun shines and what throws shadows.

        """
        self._recorder, self._map, self._place = recorder, ZoneMap(zone), place
        self._obstacles = place.obstacles()
        self._trail: set[tuple[int, int]] = set()

    def draw(self, now: float, factor: float) -> RenderableType:
        """Return the picture at simulated ``now`` [s], passing ``factor`` times real time."""
        moment = datetime.fromtimestamp(now, timezone.utc)
        title = f'{moment:%d %B %Y, %H:%M:%S} UTC, {factor:.0f} times real time'
        return Columns([Panel(self._walk(now), title=title), self._numbers()])

    def _walk(self, now: float) -> Text:
        """Shade as dots, the trail, the goal and the tree."""
        light = sun(now, self._place.latitude, self._place.longitude)
        truth, goal = self._recorder.latest('ground_truth'), self._recorder.latest('goal')
        marks: dict[tuple[int, int], Mark] = {}
        if truth is not None:
            here = self._map.cell_of(truth.pose.pose.position.x, truth.pose.pose.position.y)
            self._trail.add(here)
        marks.update(dict.fromkeys(self._trail, ('•', 'green')))
        if goal is not None:
            marks[self._map.cell_of(goal.pose.position.x, goal.pose.position.y)] = ('✕', 'bold red')
        if truth is not None:
            marks[here] = ('♣', 'bold green')
        return self._map.text(
            marks, lambda x, y: '░' if sunlit(x, y, light, self._obstacles) < 0.5 else ' '
        )

    def _numbers(self) -> Table:
        table = Table(box=None, show_header=False, pad_edge=False)
        recorder = self._recorder
        state = recorder.latest('state')
        table.add_row('state', '' if state is None else state.data)
        flow = recorder.latest('granier/sap_flow')
        for name, axis in (('s1 speed', 'x'), ('s2 rotation', 'y'), ('s3 places', 'z')):
            if flow is not None:
                value = getattr(flow.vector, axis)
                table.add_row(name, f'{"█" * round(20 * value):<20} {value:.2f}')
        twist = recorder.latest('cmd_vel')
        if twist is not None:
            speed = hypot(twist.twist.linear.x, twist.twist.linear.y) * 60.0
            turn = twist.twist.angular.z * 60.0 * 180.0 / pi
            table.add_row('twist', f'{speed:.2f} m/min, {turn:+.0f} deg/min')
        for row in self._turrets():
            table.add_row(*row)
        truth = recorder.latest('ground_truth')
        if truth is not None:
            pose: Pose = pose_of(truth.pose.pose)
            table.add_row(
                'pose', f'{pose.x:.2f} m, {pose.y:.2f} m, {pose.theta * 180 / pi:.0f} deg'
            )
        return table

    def _turrets(self) -> list[tuple[str, str]]:
        """One line a turret: which way it points and how fast it rolls."""
        state = self._recorder.latest('turrets/state')
        if state is None:
            return []
        angles, rates = TurretJoints(len(state.name) // 2).read(state)
        return [
            (
                f'turret {i}',
                f'{ARROWS[round(angle / (pi / 4)) % 8]} {60 * rate * self._radius:+.2f} m/min',
            )
            for i, (angle, rate) in enumerate(zip(angles, rates, strict=True))
        ]

    @property
    def _radius(self) -> float:
        return self._place.wheel_radius
