"""The figure of a run: planned against driven, and the errors over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import style
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.report.run import Poses, RunBag
    from agv_motion.report.run_errors import Errors

SMOOTHED = 0.2
"""[s] Over which the speed of a noisy pose is taken."""

RIM = 0.04
"""of the extent of the map: so large the robot is drawn; a bag does not tell its true size."""


def draw(run: RunBag, errors: Errors | None, path: Path, *, theme: str = 'light') -> None:
    """Draw a run into a picture; without a Ghost there are no errors in time.

    Then how far it was from the ways that were shown is drawn, where some were.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    off = off_the_way(run) if errors is None else None
    rows = ['speed'] if errors is None else ['place', 'heading', 'speed']
    rows = ['place', 'speed'] if off is not None else rows
    mosaic: list[Any] = [['map', row] for row in rows]
    with figure(
        path, mosaic, theme=theme, figsize=(style.WIDTH, 5.4), width_ratios=[1.1, 1]
    ) as axes:
        style.title(axes['map'], finding(run, errors, off))
        _draw_map(axes['map'], run)
        if errors is not None:
            _draw_errors(axes, errors, float(run.driven.time[0]))
        if off is not None:
            time = run.driven.time - run.driven.time[0]
            axes['place'].plot(*style.thinned(time, 100.0 * off), color=style.ROBOT)
            axes['place'].set(ylabel='[cm]', ylim=(0.0, None), title='Distance from the way shown')
        _draw_speed(axes['speed'], run)
        for row in rows:
            axes[row].grid()
            axes[row].set_xlim(0.0, max(run.duration(), 1e-3))
            axes[row].tick_params(labelbottom=row == rows[-1])


def off_the_way(run: RunBag) -> Any:
    """Return (n,) how far the robot was from the nearest of all ways shown [m].

    None without a way, and where a way is in another frame than the robot.
    """
    import shapely

    ways = [way for shown in run.ways.values() for way in shown if len(way) > 1]
    if not ways or run.way_frames != {run.driven.frame}:
        return None
    lines = shapely.MultiLineString(ways)
    return shapely.distance(shapely.points(run.driven.pose[:, :2]), lines)


def finding(run: RunBag, errors: Errors | None, off: Any) -> str:
    """Return what the run was, in one line, from its numbers."""
    said = f'{run.distance():.1f} m in {run.duration():.0f} s'
    if errors is not None and len(errors.time):
        worst = 100.0 * errors.distance.max()
        return f'{said}, {100.0 * errors.rms():.1f} cm from the plan, at most {worst:.1f} cm'
    if off is not None:
        return f'{said}, never more than {100.0 * off.max():.0f} cm from the way'
    return said


def _draw_map(axes: Any, run: RunBag) -> None:
    """Draw ways and plan, what was driven, and the robot at both ends."""
    place = run.driven.pose[:, :2]
    shown = [way for ways in run.ways.values() for way in ways]
    for way in shown:
        axes.plot(*way.T, color=style.PATH, alpha=0.35, lw=5)
    axes.plot(*place.T, color=style.ROBOT, lw=1.3)
    style.direction(axes, place, style.ROBOT, 5)
    words = ['driven (blue)', *(['way shown (green)'] if shown else [])]
    everywhere = [place, *shown]
    if run.planned is not None:
        plan = run.planned.pose[:, :2].copy()
        plan[1:][np.diff(run.planned.time) > SMOOTHED * 2] = np.nan  # another drive
        axes.plot(*plan.T, color=style.ink(), ls=(0, (5, 3)), lw=1)
        everywhere.append(plan)
        words.append('plan (dashed)')
    extent = float(np.ptp(place, axis=0).max()) + 0.1
    style.frame(axes, np.concatenate(everywhere), 0.12 * extent)
    taken = list(place[:: max(len(place) // 100, 1)])
    together = np.hypot(*(place[-1] - place[0])) < RIM * extent
    ends = [(-1, 'start and end')] if together else [(0, 'start'), (-1, 'end')]
    for row, name in ends:
        style.robot(axes, run.driven.pose[row], RIM * extent, strong=True)
        style.name_near(axes, place[row], 1.7 * RIM * extent, name, style.ROBOT, taken)
    axes.set_title(', '.join(words), fontsize=style.SMALL, fontweight='normal')


def _draw_errors(axes: dict[str, Any], errors: Errors, start: float) -> None:
    time = errors.time - start
    for name, values, colour in (
        ('along', errors.along, style.ROBOT), ('across', errors.across, style.OTHERS[0]),
    ):  # fmt: skip
        axes['place'].plot(*_broken(time, 100.0 * values), lw=1.0, color=colour)
        if len(values):
            style.line_label(axes['place'], 100.0 * float(values[-1]), name, colour)
    axes['place'].set(ylabel='[cm]', title='Error of place')
    axes['heading'].plot(*_broken(time, np.degrees(errors.heading)), lw=1.0, color=style.ROBOT)
    axes['heading'].set(ylabel='[°]', title='Error of heading')


def _draw_speed(axes: Any, run: RunBag) -> None:
    for poses, colour, name in (
        (run.driven, style.ROBOT, 'driven'), (run.planned, style.ink(), 'plan'),
    ):  # fmt: skip
        if poses is not None:
            time, speed = _speed(poses)
            axes.plot(*style.thinned(time - run.driven.time[0], speed), color=colour, lw=1)
            if run.planned is not None and np.isfinite(speed).any():
                style.line_label(axes, float(speed[np.isfinite(speed)][-1]), name, colour)
    axes.set(ylabel='[m/s]', xlabel='time [s]', title='Speed')


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
