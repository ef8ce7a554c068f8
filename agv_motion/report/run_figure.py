"""The figure of a run: planned against driven, and the errors over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import robot_drawing, style, wording
from agv_motion.report.figure import figure
from agv_motion.report.recorded_footprint import moments

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.report.run import Poses, RunBag
    from agv_motion.report.run_errors import Errors

SMOOTHED = 0.2
"""[s] Over which the speed of a noisy pose is taken."""

SILENCE = 2.0 * SMOOTHED
"""[s] Over a longer time without a pose, if that is not usual in the run, no line is drawn."""

STILL = 1e-3
"""[m] A robot that went no further has stood."""


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
            _draw_errors(axes, run, errors)
        if off is not None:
            line = style.broken(_since(run, run.driven.time), 100.0 * off, SILENCE)
            axes['place'].plot(*style.thinned(*line), color=style.ROBOT)
            axes['place'].set(ylabel='[cm]', ylim=(0.0, None), title='Distance from the way shown')
        _draw_speed(axes['speed'], run)
        for note in run.notes:
            words = wording.clipped(note.text, wording.LONGEST_NOTE)
            others = [axes[row] for row in rows[1:]]
            style.event(axes[rows[0]], _since(run, 1e-9 * note.stamp), words, also=others)
        for row in rows:
            axes[row].grid()
            style.time_axis(axes[row], run.duration())
            axes[row].tick_params(labelbottom=row == rows[-1])
            if row != rows[-1]:
                axes[row].set_xlabel('')


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
    span = f'{run.duration():.0f} s'
    if run.duration() > MOST_SECONDS:
        span = wording.span_in_words(run.duration())
    said = f'{wording.length(run.distance())} in {span}'
    if run.distance() < STILL:
        said = f'stands for {span}'
    if errors is not None and len(errors.time):
        worst = 100.0 * errors.distance.max()
        return f'{said}, {100.0 * errors.rms():.1f} cm from the plan, at most {worst:.1f} cm'
    if off is not None:
        return f'{said}, never more than {100.0 * off.max():.0f} cm from the way'
    return said


MOST_SECONDS = 600.0
"""[s] A longer run is told in minutes, hours and days."""


def _draw_map(axes: Any, run: RunBag) -> None:
    """Draw ways and plan, what was driven, and the robot at both ends."""
    place = run.driven.pose[:, :2]
    shown = [way for ways in run.ways.values() for way in ways]
    for way in shown:
        axes.plot(*way.T, color=style.PATH, alpha=0.35, lw=5)
    _, joined = style.broken(run.driven.time, place, SILENCE)
    axes.plot(*joined.T, color=style.ROBOT, lw=1.3)
    style.direction(axes, joined, style.ROBOT, 5)
    words = ['driven (blue)', *(['way shown (green)'] if shown else [])]
    everywhere = [place, *shown]
    if run.planned is not None:
        _, plan = style.broken(run.planned.time, run.planned.pose[:, :2], SILENCE)
        axes.plot(*plan.T, color=style.ink(), ls=(0, (5, 3)), lw=1)
        everywhere.append(plan)
        words.append('plan (dashed)')
    known = np.concatenate(everywhere)
    known = known[np.isfinite(known).all(axis=1)]
    extent = float(np.ptp(known, axis=0).max(initial=0.0)) + 0.1
    shapes = robot_drawing.visible(run.footprints, extent)
    style.frame(axes, known, robot_drawing.room(shapes, extent))
    taken = list(place[:: max(len(place) // 100, 1)])
    robot_drawing.draw_way(axes, run.driven.pose[moments(len(place))], shapes)
    robot_drawing.name_ends(axes, place[[0, -1]], shapes, extent, taken)
    words.append(robot_drawing.caption(shapes))
    axes.set_title(', '.join(words), fontsize=style.SMALL, fontweight='normal')


def _since(run: RunBag, time: Any) -> Any:
    """Return times since the start of a run, in the unit of its axis."""
    return (time - run.driven.time[0]) / style.time_unit(run.duration())[0]


def _draw_errors(axes: dict[str, Any], run: RunBag, errors: Errors) -> None:
    def line(values: Any) -> tuple[Any, Any]:
        time, joined = style.broken(errors.time, values, SILENCE)
        return style.thinned(_since(run, time), joined)

    for name, values, colour in (
        ('along', errors.along, style.ROBOT), ('across', errors.across, style.OTHERS[0]),
    ):  # fmt: skip
        axes['place'].plot(*line(100.0 * values), lw=1.0, color=colour)
        if len(values):
            style.line_label(axes['place'], 100.0 * float(values[-1]), name, colour)
    axes['place'].set(ylabel='[cm]', title='Error of place')
    style.scale(axes['place'], 100.0 * errors.along, 100.0 * errors.across, least=0.5)
    axes['heading'].plot(*line(np.degrees(errors.heading)), lw=1.0, color=style.ROBOT)
    style.scale(axes['heading'], np.degrees(errors.heading), least=1.0)
    axes['heading'].set(ylabel='[°]', title='Error of heading')


def _draw_speed(axes: Any, run: RunBag) -> None:
    speeds = []
    for poses, colour, name in (
        (run.driven, style.ROBOT, 'driven'), (run.planned, style.ink(), 'plan'),
    ):  # fmt: skip
        if poses is not None:
            time, speed = _speed(poses)
            speeds.append(speed)
            axes.plot(*style.thinned(_since(run, time), speed), color=colour, lw=1)
            if run.planned is not None and np.isfinite(speed).any():
                style.line_label(axes, float(speed[np.isfinite(speed)][-1]), name, colour)
    style.scale(axes, *speeds, least=0.02)
    axes.set(ylabel='[m/s]', title='Speed')


def _speed(poses: Poses) -> tuple[Any, Any]:
    """Return times and speeds [m/s] over a short while, forward positive; NaN over gaps."""
    if len(poses.time) < 2:
        return np.empty(0), np.empty(0)
    usual = float(np.median(np.diff(poses.time)))
    step = max(round(SMOOTHED / max(usual, 1e-3)), 1)
    first, last = poses.pose[:-step], poses.pose[step:]
    elapsed = poses.time[step:] - poses.time[:-step]
    moved = last[:, :2] - first[:, :2]
    ahead = moved[:, 0] * np.cos(first[:, 2]) + moved[:, 1] * np.sin(first[:, 2])
    speed = np.where(elapsed < 3.0 * max(SMOOTHED, step * usual), ahead / elapsed, np.nan)
    return poses.time[:-step] + 0.5 * elapsed, speed
