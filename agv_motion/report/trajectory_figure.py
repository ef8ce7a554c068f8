"""The figure of a planned trajectory: its way, its speeds, and which limit holds it down."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report.figure import figure
from agv_motion.trajectory.feasibility import examine

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.trajectory.ghost_parameters import GhostParameters
    from agv_motion.trajectory.trajectory import Trajectory

SAMPLES = 1000

NEAR = 0.02
"""[m] So far around a place where it is slow the way is marked, to be seen."""

COLOURS = {
    'lateral acceleration': 'tab:red',
    'wheel speed': 'tab:orange',
    'turn rate': 'tab:purple',
    'jump of curvature': 'tab:brown',
}


def draw(trajectory: Trajectory, limits: GhostParameters, path: Path) -> None:
    """Draw ``trajectory`` of a robot with ``limits`` into a picture.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    time = np.linspace(0.0, trajectory.duration, SAMPLES)
    poses = np.array([trajectory.pose(t) for t in time.tolist()])
    speeds = np.array([trajectory.speeds(t) for t in time.tolist()])
    driven = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(poses[:, :2], axis=0).T))))
    with figure(
        path, [['map', 'speed'], ['map', 'turn']], figsize=(13, 6.5), width_ratios=[1.1, 1]
    ) as axes:
        held = {slow.reason: np.zeros(SAMPLES, dtype=bool) for slow in examine(trajectory).slow}
        for slow in examine(trajectory).slow:
            held[slow.reason] |= (driven >= slow.start - NEAR) & (driven <= slow.end + NEAR)
        _draw_map(axes['map'], poses, held)
        _draw_speeds(axes['speed'], time, speeds, limits, held)
        axes['turn'].plot(time, speeds[:, 1], 'k', lw=1.2)
        axes['turn'].set(xlabel='time [s]', ylabel='turn rate [rad/s]')
        axes['turn'].grid(alpha=0.3)


def _draw_map(axes: Any, poses: Any, held: dict[str, Any]) -> None:
    axes.plot(*poses[:, :2].T, color='0.3', lw=2)
    for reason, here in held.items():
        way = np.where(here[:, None], poses[:, :2], np.nan)
        axes.plot(*way.T, lw=5, alpha=0.5, color=COLOURS[reason], label=f'slow: {reason}')
    every = poses[:: SAMPLES // 20]
    axes.quiver(
        every[:, 0], every[:, 1], np.cos(every[:, 2]), np.sin(every[:, 2]), color='tab:blue',
        angles='xy', scale=35, width=0.004, label='heading',
    )  # fmt: skip
    axes.plot(*poses[0, :2], 's', color='k', label='start')
    axes.plot(*poses[-1, :2], '*', ms=12, color='k', label='end')
    axes.set(aspect='equal', adjustable='datalim', xlabel='x [m]', ylabel='y [m]')
    axes.grid(alpha=0.3)
    axes.legend(fontsize='small')


def _draw_speeds(
    axes: Any, time: Any, speeds: Any, limits: GhostParameters, held: dict[str, Any]
) -> None:
    linear, across = speeds[:, 0], 0.5 * limits.track * speeds[:, 1]
    axes.plot(time, linear, 'k', lw=1.5, label='robot')
    axes.plot(time, linear - across, color='tab:blue', lw=0.8, label='left wheel')
    axes.plot(time, linear + across, color='tab:green', lw=0.8, label='right wheel')
    for reason, here in held.items():
        axes.fill_between(time, linear, where=here, color=COLOURS[reason], alpha=0.3, lw=0)
    axes.set(ylabel='speed [m/s]')
    axes.grid(alpha=0.3)
    axes.legend(fontsize='small')
