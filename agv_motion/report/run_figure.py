"""The figure of a run: planned against driven, and the errors over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.report.run import Poses, RunBag
    from agv_motion.report.run_errors import Errors

SMOOTHED = 0.2
"""[s] Over which the speed of a noisy pose is taken."""


def draw(run: RunBag, errors: Errors | None, path: Path) -> None:
    """Draw a run into a picture; without a Ghost the errors are left out.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    rows = ['speed'] if errors is None else ['place', 'heading', 'speed']
    start = float(run.driven.time[0])
    with figure(
        path, [['map', row] for row in rows], figsize=(13, 7), width_ratios=[1.1, 1]
    ) as axes:
        _draw_map(axes['map'], run)
        if errors is not None:
            _draw_errors(axes, errors, start)
        for poses, style in ((run.driven, 'tab:blue'), (run.planned, 'k')):
            if poses is not None:
                time, speed = _speed(poses)
                axes['speed'].plot(time - start, speed, color=style, lw=1, label=poses.topic)
        axes['speed'].set(ylabel='speed [m/s]', xlabel='time [s]')
        axes['speed'].legend(fontsize='small')
        for row in rows:
            axes[row].grid(alpha=0.3)
            axes[row].sharex(axes[rows[0]])


def _draw_map(axes: Any, run: RunBag) -> None:
    for topic, ways in run.ways.items():
        for i, way in enumerate(ways):
            axes.plot(*way.T, color='0.8', lw=5, zorder=1, label=None if i else topic)
    axes.plot(*run.driven.pose[:, :2].T, color='tab:blue', lw=1.2, label=run.driven.topic)
    if run.planned is not None:
        place = run.planned.pose[:, :2].copy()
        place[1:][np.diff(run.planned.time) > SMOOTHED * 2] = np.nan  # another drive
        axes.plot(*place.T, 'k--', lw=1, label=run.planned.topic)
    axes.plot(*run.driven.pose[0, :2], 's', color='tab:blue', label='start')
    axes.plot(*run.driven.pose[-1, :2], '*', ms=12, color='tab:blue', label='end')
    axes.set(aspect='equal', adjustable='datalim', xlabel='x [m]', ylabel='y [m]')
    axes.grid(alpha=0.3)
    axes.legend(fontsize='small')


def _draw_errors(axes: dict[str, Any], errors: Errors, start: float) -> None:
    time = errors.time - start
    for name, values in (('along', errors.along), ('across', errors.across)):
        axes['place'].plot(*_broken(time, 100.0 * values), lw=0.8, label=name)
    axes['place'].set(ylabel='error [cm]', title=f'root mean square {100.0 * errors.rms():.2f} cm')
    axes['place'].legend(fontsize='small')
    axes['heading'].plot(*_broken(time, np.degrees(errors.heading)), lw=0.8, color='tab:green')
    axes['heading'].set(ylabel='heading error [deg]')


def _broken(time: Any, values: Any) -> tuple[Any, Any]:
    """Return a curve with a gap where nothing was driven."""
    gaps = np.flatnonzero(np.diff(time) > SMOOTHED * 2) + 1
    return np.insert(time, gaps, np.nan), np.insert(values, gaps, np.nan)


def _speed(poses: Poses) -> tuple[Any, Any]:
    """Return times and speeds [m/s] over a short while, forward positive; NaN over gaps."""
    step = max(round(SMOOTHED / max(float(np.median(np.diff(poses.time))), 1e-3)), 1)
    first, last = poses.pose[:-step], poses.pose[step:]
    elapsed = poses.time[step:] - poses.time[:-step]
    moved = last[:, :2] - first[:, :2]
    ahead = moved[:, 0] * np.cos(first[:, 2]) + moved[:, 1] * np.sin(first[:, 2])
    speed = np.where(elapsed < 3.0 * SMOOTHED, ahead / elapsed, np.nan)
    return poses.time[:-step] + 0.5 * elapsed, speed
