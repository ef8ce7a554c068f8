"""The demo as it runs, in the terminal: the zone, the trail, the probes and the turrets."""

from __future__ import annotations

from datetime import datetime, timezone
from math import hypot, pi
from typing import TYPE_CHECKING

from agv_motion.demo.map_view import NUMBERS, MapView, Room
from agv_motion.demo.readout import NOT_YET, lines, number, pace, pose_text
from agv_motion.ros.messages import TurretJoints, pose_of
from agv_motion.simulation.shade import sunlit
from agv_motion.sun import sun

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.text import Text

    from agv_motion.demo.recorder import DemoRecorder
    from agv_motion.demo.zone_map import Mark
    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.nodes.simulator import SimulatorParameters

ARROWS = '→↗↑↖←↙↓↘'

BAR = 15
"""Characters of a full sap flow"""


class TreeView:
    """Draws what the recorder has heard."""

    def __init__(
        self, recorder: DemoRecorder, zone: Zone, place: SimulatorParameters, *,
        drinks: bool = False,
    ) -> None:  # fmt: skip
        """Start with an empty trail.

        Args:
            recorder: What has been heard.
            zone: To draw.
            place: Where the sun shines and what throws shadows.
            drinks: Whether the area of its sapwood is known, and so what it drinks.

        """
        self._recorder, self._view, self._place = recorder, MapView(zone), place
        self._drinks = drinks
        self._obstacles = place.obstacles()
        self._trail: list[tuple[float, float]] = []

    def draw(self, now: float, factor: float, room: Room) -> RenderableType:
        """Return the picture at simulated ``now`` [s], passing ``factor`` times real time."""
        self._view.fit(room)
        moment = datetime.fromtimestamp(now, timezone.utc)
        title = f'{moment:%d %b %Y, %H:%M:%S} UTC'
        numbers = lines(self._numbers(factor), NUMBERS, tall=5)
        return self._view.picture(title, self._walk(now), numbers)

    def _walk(self, now: float) -> Text:
        """Shade as dots, the trail, the goal and the tree."""
        light = sun(now, self._place.latitude, self._place.longitude)
        truth, goal = self._recorder.latest('ground_truth'), self._recorder.latest('goal')
        cell_of = self._view.map.cell_of
        if truth is not None:
            here = truth.pose.pose.position.x, truth.pose.pose.position.y
            self._trail.append(here)
        marks: dict[tuple[int, int], Mark] = {cell_of(*at): ('•', 'green') for at in self._trail}
        if goal is not None:
            marks[cell_of(goal.pose.position.x, goal.pose.position.y)] = ('✕', 'bold red')
        if truth is not None:
            marks[cell_of(*here)] = ('♣', 'bold green')
        return self._view.map.text(
            marks, lambda x, y: '░' if sunlit(x, y, light, self._obstacles) < 0.5 else ' '
        )

    def _numbers(self, factor: float) -> list[tuple[str, str]]:
        """Return what stands beside the map; what is not known yet has its line all the same."""
        latest = self._recorder.latest
        state, flow, twist = latest('state'), latest('granier/sap_flow'), latest('cmd_vel')
        rows = [('pace', pace(factor))]
        for name, axis in (('speed', 'x'), ('turn', 'y'), ('places', 'z')):
            value = 0.0 if flow is None else getattr(flow.vector, axis)
            bar = '█' * round(BAR * min(max(value, 0.0), 1.0))
            rows.append((name, NOT_YET if flow is None else f'{bar:<{BAR}} {number(value, 5, 2)}'))
        if self._drinks:
            rows.append(('drank', self._litres()))
        speed = turn = 0.0
        if twist is not None:
            speed = hypot(twist.twist.linear.x, twist.twist.linear.y) * 60.0
            turn = twist.twist.angular.z * 60.0 * 180.0 / pi
        moves = f'{number(speed, 5, 2)} m/min {number(turn, 4, 0, sign=True)}°/min'
        rows += [('twist', NOT_YET if twist is None else moves), *self._turrets()]
        truth = latest('ground_truth')
        rows.append(('pose', NOT_YET if truth is None else pose_text(pose_of(truth.pose.pose))))
        rows.append(('state', NOT_YET if state is None else state.data))
        return rows

    def _litres(self) -> str:
        """Return what it drank today with its interval, in one width."""
        told = self._recorder.latest('granier/water_use_today')
        if told is None:
            return NOT_YET
        litres = told.vector.x, told.vector.y, told.vector.z
        digits = 2 if max(litres) < 99.995 else 1 if max(litres) < 999.95 else 0
        value, low, high = (number(each, 5, digits) for each in litres)
        return f'{value} L {low} to {high}'

    def _turrets(self) -> list[tuple[str, str]]:
        """One line a turret: which way it points and how fast it rolls."""
        state = self._recorder.latest('turrets/state')
        if state is None:
            return [(f'wheel{i}', NOT_YET) for i in range(len(self._place.turret_x))]
        angles, rates = TurretJoints(len(state.name) // 2).read(state)
        return [
            (
                f'wheel{i}',
                (
                    f'{ARROWS[round(angle / (pi / 4)) % 8]} '
                    f'{number(60 * rate * self._place.wheel_radius, 6, 2, sign=True)} m/min'
                ),
            )
            for i, (angle, rate) in enumerate(zip(angles, rates, strict=True))
        ]
