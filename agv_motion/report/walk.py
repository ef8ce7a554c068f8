"""The walk of a tree, read back from its bag: columns, and figures of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from rich.table import Table

from agv_motion.bag.message_objects import decoded
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.report.litres import LitresDrunk, in_litres
from agv_motion.report.recorded_footprint import moments, read_footprints
from agv_motion.ros.messages import pose_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader
    from agv_motion.model.footprint import Footprint
    from agv_motion.motion.navigation.zone import Zone


READ = {
    'ground_truth': 4, 'granier/sap_flow': 4, 'turrets/command': 4, 'turrets/residual': 2,
    'goal': 3, 'granier/water_use_today': 4,
}  # fmt: skip
"""Topics of the bag that the report needs, in the order of the fields of `WalkRun`, and the columns
of each, where nothing came."""


WALKING = 'walking to '
"""How the state begins that tells the reason of a goal."""


class Remembered(NamedTuple):
    """A map of the memory, as published."""

    x: NDArray[np.float64]
    """(columns + 1,) edges of the cells [m]"""
    y: NDArray[np.float64]
    """(rows + 1,) edges of the cells [m]"""
    values: NDArray[np.float64]
    """(rows, columns), NaN where unknown"""


class WalkRun(NamedTuple):
    """The bag of a demo as columns; times in seconds since its start."""

    path: NDArray[np.float64]
    """(n, 4) time, x, y, heading of the true pose"""
    flow: NDArray[np.float64]
    """(m, 4) time, s1, s2, s3"""
    speeds: NDArray[np.float64]
    """(k, 1 + turrets) time, commanded wheel speeds [m/s]"""
    residual: NDArray[np.float64]
    """(k, 2) time, residual [m/s]"""
    goals: NDArray[np.float64]
    """(g, 3) time, x, y"""
    reasons: list[str]
    """of each goal, in words"""
    felt: Remembered | None
    """sap flow remembered at the end, 0 to 100; None without a memory"""
    visited: Remembered | None
    """time since the last visit"""
    footprints: list[Footprint] | None = None
    """of the tree at the `moments` of its path; None where the bag does not tell its size"""
    water: NDArray[np.float64] | None = None
    """(w, 4) time, what it drank since midnight [l], and the 95 % interval; None: nobody told"""

    def distance(self) -> float:
        """Return the length of the way [m]."""
        return float(np.hypot(*np.diff(self.path[:, 1:3], axis=0).T).sum())

    def drunk(self) -> LitresDrunk:
        """Return what it drank."""
        found = LitresDrunk()
        for _, value, low, high in () if self.water is None else self.water.tolist():
            found.add(value, low, high)
        return found

    def share_inside(self, zone: Zone) -> float:
        """Return the share of the time in which the centre was inside the zone."""
        if not len(self.path):
            return 0.0
        return float(np.mean([zone.contains(x, y) for _, x, y, _ in self.path[::10]]))

    def nearest_edge(self, zone: Zone, rim: float) -> float:
        """Return how near the rim came to an edge [m]; negative: over it. NaN without a path."""
        return min(
            (
                (1.0 if zone.contains(x, y) else -1.0) * zone.edge_distance(x, y) - rim
                for _, x, y, _ in self.path
            ),
            default=float('nan'),
        )


def read_walk(bag: BagReader, wheel_radius: float) -> WalkRun:
    """Read the bag back."""
    rows: dict[str, list[tuple[float, ...]]] = {name: [] for name in READ}
    states: list[tuple[float, str]] = []
    maps: dict[str, Remembered] = {}
    names = {*rows, 'state', 'memory/sap_flow', 'memory/last_visit'}
    for message, content in decoded(bag, [t for t in bag.topics if t.lstrip('/') in names]):
        name, time = message.connection.topic.lstrip('/'), (message.stamp - bag.start) * 1e-9
        if name == 'state':
            states.append((time, content.data))
        elif name in rows:
            rows[name].append((time, *_numbers(name, content, wheel_radius)))
        else:
            maps[name] = _remembered(content)
    columns = (
        np.array(rows[name] or np.empty((0, width)), dtype=float) for name, width in READ.items()
    )
    path, flow, speeds, residual, goals, water = columns
    stamps = (path[moments(len(path)), 0] + bag.start * 1e-9).tolist()
    return WalkRun(
        path, flow, speeds, residual, goals, _reasons(goals, states),
        maps.get('memory/sap_flow'), maps.get('memory/last_visit'),
        read_footprints(bag, '/ground_truth', stamps), water if len(water) else None,
    )  # fmt: skip


def _reasons(goals: NDArray[np.float64], states: list[tuple[float, str]]) -> list[str]:
    """Return the reason of each goal: the first word of walking there, before the next goal."""
    walking = [
        (t, text.removeprefix(WALKING).split(';')[0])
        for t, text in states
        if text.startswith(WALKING)
    ]
    ends = [*(goal[0] for goal in goals[1:]), np.inf][: len(goals)]
    return [
        next((text for t, text in walking if goal[0] - 1.0 < t < end), '')
        for goal, end in zip(goals, ends, strict=True)
    ]


def _remembered(message: Any) -> Remembered:
    info = message.info
    values = np.array(message.data, dtype=float).reshape(info.height, info.width)
    values[values < 0.0] = np.nan
    return Remembered(
        info.origin.position.x + info.resolution * np.arange(info.width + 1),
        info.origin.position.y + info.resolution * np.arange(info.height + 1),
        values,
    )


def _numbers(name: str, message: Any, wheel_radius: float) -> tuple[float, ...]:
    if name == 'ground_truth':
        return pose_of(message.pose.pose)
    if name.startswith('granier/'):
        return message.vector.x, message.vector.y, message.vector.z
    if name == 'turrets/command':
        joints = zip(message.name, message.velocity, strict=True)
        return tuple(rate * wheel_radius for name, rate in joints if name.endswith('_wheel'))
    if name == 'goal':
        return message.pose.position.x, message.pose.position.y
    return (message.data,)


class WalkOutcome(NamedTuple):
    """What the run itself knows beside its bag."""

    simulated: float
    """[s]"""
    factor: float
    """[-] simulated over real time, as achieved"""
    latencies: NDArray[np.float64]
    """[s] from a sap flow to the next turret command"""
    counts: dict[str, int]
    """messages by topic"""


def summary(
    run: WalkRun,
    outcome: WalkOutcome,
    zone: Zone,
    max_wheel_speed: float,
    rim: float = PLATFORM_RADIUS,
) -> Table:
    """Return the figures of a run as a table; ``rim`` of the platform from its centre [m]."""
    table = Table(title='The walk', show_header=False, title_justify='left', box=None)
    top = float(np.abs(run.speeds[:, 1:]).max()) if len(run.speeds) else 0.0
    residual = run.residual[:, 1] if len(run.residual) else np.zeros(1)
    table.add_row('simulated time', f'{outcome.simulated / 60:.1f} min')
    table.add_row('time factor achieved', f'{outcome.factor:.1f}')
    table.add_row('distance', f'{run.distance():.2f} m')
    table.add_row('time inside the zone', f'{100 * run.share_inside(zone):.1f} %')
    table.add_row('rim to the nearest edge', f'{run.nearest_edge(zone, rim):.2f} m at least')
    table.add_row('top wheel speed', f'{60 * top:.3f} m/min (limit {60 * max_wheel_speed:.3f})')
    table.add_row(
        'residual of the turrets',
        f'{1e3 * np.median(residual):.3f} mm/s median, {1e3 * residual.max():.3f} mm/s at most',
    )
    drunk = run.drunk()
    for name, litres in (
        ('drank today', drunk.since_midnight()),
        ('drank in all', drunk.total() if drunk.stretches > 1 else None),
    ):
        if litres is not None:
            table.add_row(name, f'{in_litres(litres)}, with 95 % confidence')
    if len(outcome.latencies):
        p50, p99 = np.percentile(outcome.latencies, [50, 99]) * 1e3
        table.add_row('probe to turrets', f'{p50:.2f} ms median, {p99:.2f} ms p99')
    for i, (topic, count) in enumerate(outcome.counts.items()):
        table.add_row('' if i else 'messages per topic', f'{count:6d}  {topic}')
    return table
