"""The walk of a tree in one figure: zone, memory, trail and goals; probes, wheels, residual."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.motion.command.polar import PLATFORM_RADIUS
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.report.walk import WalkRun

PLATFORMS = 5
"""Times at which the platform is drawn."""

GOALS_LISTED = 12
"""Goals that the figure has room for."""


def draw(
    run: WalkRun, zone: Zone, max_wheel_speed: float, path: Path, rim: float = PLATFORM_RADIUS
) -> None:
    """Draw zone and trail, probes, wheel speeds and residual into one picture.

    Args:
        run: What was recorded.
        zone: Where the tree walked.
        max_wheel_speed: Limit of the wheels [m/s].
        path: Of the picture.
        rim: How far the platform reaches from its centre [m]; it is drawn at its true size.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    mosaic = [['map', 'flow'], ['map', 'speed'], ['goals', 'residual']]
    with figure(path, mosaic, figsize=(13, 7), width_ratios=[1.25, 1]) as axes:
        _draw_map(axes['map'], run, zone, rim)
        _list_goals(axes['goals'], run)
        _draw_signals(axes, run, max_wheel_speed)


def _draw_signals(axes: dict[str, Any], run: WalkRun, max_wheel_speed: float) -> None:
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


def _draw_map(axes: Any, run: WalkRun, zone: Zone, rim: float) -> None:
    """Draw the floor, its margin, and the memory, the trail and the goals."""
    import shapely

    for part, style in ((zone.floor, 'k-'), *((p, 'k:') for p in zone.parts)):
        for ring in (part.exterior, *part.interiors):
            axes.plot(*np.array(ring.coords).T, style, lw=1)
    for area in zone.translation_only:
        axes.fill(*np.array(area.exterior.coords).T, color='orange', alpha=0.2)
    if run.visited is not None:
        axes.pcolormesh(run.visited.x, run.visited.y, 0.0 * run.visited.values, cmap='Greys',
                        vmin=-0.12, vmax=1.0)  # fmt: skip
    if run.felt is not None:
        felt = axes.pcolormesh(run.felt.x, run.felt.y, run.felt.values / 100.0, cmap='viridis',
                               vmin=0.0, vmax=1.0)  # fmt: skip
        axes.figure.colorbar(felt, ax=axes, label='s3 remembered (grey: visited)', shrink=0.7)
    if len(run.path):
        axes.plot(*run.path[:, 1:3].T, lw=0.8, color='white')
        axes.plot(*run.path[0, 1:3], 'o', color='tab:green', label='start')
        axes.plot(*run.path[-1, 1:3], '^', color='tab:green', label='end')
        _draw_platforms(axes, run, rim)
    for i, (_, x, y) in enumerate(run.goals):
        axes.annotate(
            f'{i + 1}', (x, y), color='white', fontsize='small', ha='center', va='center',
            bbox={'boxstyle': 'circle', 'facecolor': 'tab:red', 'edgecolor': 'none'},
        )  # fmt: skip
    west, south, east, north = shapely.total_bounds(zone.floor)
    axes.set(
        aspect='equal', xlabel='x [m]', ylabel='y [m]',
        xlim=(west - 0.5, east + 0.5), ylim=(south - 0.5, north + 0.5),
    )  # fmt: skip
    if len(run.path):
        axes.legend(loc='upper left', fontsize='small')


def _draw_platforms(axes: Any, run: WalkRun, rim: float) -> None:
    """Draw the platform at its true size with its heading: at the start, between, at the end."""
    from matplotlib.patches import Circle

    for row in np.linspace(0, len(run.path) - 1, PLATFORMS).astype(int):
        _, x, y, heading = run.path[row]
        last = row == len(run.path) - 1
        style = {'ec': 'tab:green' if row == 0 or last else '0.4', 'lw': 1.4 if last else 0.8}
        axes.add_patch(Circle((x, y), rim, fill=False, **style))
        ahead = x + rim * np.cos(heading), y + rim * np.sin(heading)
        axes.plot(*zip((x, y), ahead, strict=True), color=style['ec'], lw=style['lw'])


def _list_goals(axes: Any, run: WalkRun) -> None:
    """Write down when the tree set out for each goal and why: the latest, as many as fit."""
    axes.axis('off')
    lines = [
        f'{i + 1:2d}  {goal[0] / 60.0:4.0f} min  {reason}'
        for i, (goal, reason) in enumerate(zip(run.goals, run.reasons, strict=True))
    ]
    axes.text(0.0, 1.0, '\n'.join(['goals', *lines[-GOALS_LISTED:]]), va='top', fontsize='small',
              family='monospace')  # fmt: skip
