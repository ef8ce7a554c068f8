"""What the demo has shown: numbers read back from its bag, and one figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from rich.table import Table
from rosbags.highlevel import AnyReader

from agv_motion.cli.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.motion.zone import Zone


READ = ('ground_truth', 'granier/sap_flow', 'turrets/command', 'turrets/residual', 'goal')
"""Topics of the bag that the report needs, in the order of the fields of `Run`."""


class Run(NamedTuple):
    """The bag of a demo as columns; times in seconds since its start."""

    path: NDArray[np.float64]
    """(n, 3) time, x, y of the true pose"""
    flow: NDArray[np.float64]
    """(m, 4) time, s1, s2, s3"""
    speeds: NDArray[np.float64]
    """(k, 1 + turrets) time, commanded wheel speeds [m/s]"""
    residual: NDArray[np.float64]
    """(k, 2) time, residual [m/s]"""
    goals: NDArray[np.float64]
    """(g, 3) time, x, y"""

    def distance(self) -> float:
        """Return the length of the way [m]."""
        return float(np.hypot(*np.diff(self.path[:, 1:], axis=0).T).sum())

    def share_inside(self, zone: Zone) -> float:
        """Return the share of the time in which the centre was inside the zone."""
        if not len(self.path):
            return 0.0
        return float(np.mean([zone.contains(x, y) for _, x, y in self.path[::10]]))


def read_run(bag: Path, wheel_radius: float) -> Run:
    """Read the bag back."""
    rows: dict[str, list[tuple[float, ...]]] = {name: [] for name in READ}
    with AnyReader([bag]) as reader:
        start = reader.start_time
        wanted = [c for c in reader.connections if c.topic.lstrip('/') in rows]
        for connection, stamp, data in reader.messages(wanted):
            message = reader.deserialize(data, connection.msgtype)
            name = connection.topic.lstrip('/')
            rows[name].append(((stamp - start) * 1e-9, *_numbers(name, message, wheel_radius)))
    return Run(*(np.array(rows[n], dtype=float).reshape(len(rows[n]), -1) for n in READ))


def _numbers(name: str, message: Any, wheel_radius: float) -> tuple[float, ...]:
    if name == 'ground_truth':
        return message.pose.pose.position.x, message.pose.pose.position.y
    if name == 'granier/sap_flow':
        return message.vector.x, message.vector.y, message.vector.z
    if name == 'turrets/command':
        return tuple(message.velocity[len(message.velocity) // 2 :] * wheel_radius)
    if name == 'goal':
        return message.pose.position.x, message.pose.position.y
    return (message.data,)


class Outcome(NamedTuple):
    """What the run itself knows beside its bag."""

    simulated: float
    """[s]"""
    factor: float
    """[-] simulated over real time, as achieved"""
    latencies: NDArray[np.float64]
    """[s] from a sap flow to the next turret command"""
    counts: dict[str, int]
    """messages by topic"""


def summary(run: Run, outcome: Outcome, zone: Zone, max_wheel_speed: float) -> Table:
    """Return the figures of a run as a table."""
    table = Table(title='The walk', show_header=False, title_justify='left', box=None)
    top = float(np.abs(run.speeds[:, 1:]).max()) if len(run.speeds) else 0.0
    residual = run.residual[:, 1] if len(run.residual) else np.zeros(1)
    table.add_row('simulated time', f'{outcome.simulated / 60:.1f} min')
    table.add_row('time factor achieved', f'{outcome.factor:.1f}')
    table.add_row('distance', f'{run.distance():.2f} m')
    table.add_row('time inside the zone', f'{100 * run.share_inside(zone):.1f} %')
    table.add_row('top wheel speed', f'{60 * top:.3f} m/min (limit {60 * max_wheel_speed:.3f})')
    table.add_row(
        'residual of the turrets',
        f'{1e3 * np.median(residual):.3f} mm/s median, {1e3 * residual.max():.3f} mm/s at most',
    )
    if len(outcome.latencies):
        p50, p99 = np.percentile(outcome.latencies, [50, 99]) * 1e3
        table.add_row('probe to turrets', f'{p50:.2f} ms median, {p99:.2f} ms p99')
    for i, (topic, count) in enumerate(outcome.counts.items()):
        table.add_row('' if i else 'messages per topic', f'{count:6d}  {topic}')
    return table


def draw(run: Run, zone: Zone, max_wheel_speed: float, path: Path) -> None:
    """Draw zone and trail, probes, wheel speeds and residual into one picture.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    mosaic = [['map', 'flow'], ['map', 'speed'], ['map', 'residual']]
    with figure(path, mosaic, figsize=(13, 7), width_ratios=[1.25, 1]) as axes:
        _draw_map(axes['map'], run, zone)
        _draw_signals(axes, run, max_wheel_speed)


def _draw_signals(axes: dict[str, Any], run: Run, max_wheel_speed: float) -> None:
    """Draw sap flow, wheel speeds and residual over time."""
    minutes = run.flow[:, 0] / 60.0
    for i, name in enumerate(('s1: speed', 's2: rotation', 's3: places')):
        axes['flow'].plot(minutes, run.flow[:, 1 + i], label=name)
    axes['flow'].set(ylabel='sap flow', ylim=(-0.02, 1.02))
    axes['flow'].legend(loc='upper right', fontsize='small', ncols=3)
    for i in range(run.speeds.shape[1] - 1):
        axes['speed'].plot(
            run.speeds[:, 0] / 60.0, 60 * run.speeds[:, 1 + i], lw=0.8, label=f'turret {i}'
        )
    for sign in (-1, 1):
        axes['speed'].axhline(sign * 60 * max_wheel_speed, color='grey', ls=':')
    axes['speed'].set(ylabel='wheel speed [m/min]')
    axes['speed'].legend(loc='upper right', fontsize='small', ncols=3)
    axes['residual'].plot(run.residual[:, 0] / 60.0, 1e3 * run.residual[:, 1], lw=0.8)
    axes['residual'].set(ylabel='residual [mm/s]', xlabel='simulated time [min]')


def _draw_map(axes: Any, run: Run, zone: Zone) -> None:
    """Draw the floor, its margin, and the trail coloured by s3."""
    import shapely

    for part, style in ((zone.floor, 'k-'), *((p, 'k:') for p in zone.parts)):
        for ring in (part.exterior, *part.interiors):
            axes.plot(*np.array(ring.coords).T, style, lw=1)
    for area in zone.translation_only:
        axes.fill(*np.array(area.exterior.coords).T, color='orange', alpha=0.2)
    if len(run.path):
        felt = np.interp(run.path[:, 0], run.flow[:, 0], run.flow[:, 3]) if len(run.flow) else 0.0
        trail = axes.scatter(
            run.path[:, 1], run.path[:, 2], c=np.broadcast_to(felt, len(run.path)), s=4,
            cmap='viridis', vmin=0, vmax=1,
        )  # fmt: skip
        axes.figure.colorbar(trail, ax=axes, label='s3 felt', shrink=0.7)
        axes.plot(*run.path[0, 1:], 'o', color='tab:green', label='start')
        axes.plot(*run.path[-1, 1:], '^', color='tab:green', label='end')
    axes.plot(run.goals[:, 1], run.goals[:, 2], 'x', color='tab:red', label='goal')
    west, south, east, north = shapely.total_bounds(zone.floor)
    axes.set(
        aspect='equal', xlabel='x [m]', ylabel='y [m]',
        xlim=(west - 0.5, east + 0.5), ylim=(south - 0.5, north + 0.5),
    )  # fmt: skip
    axes.legend(loc='upper left', fontsize='small')
