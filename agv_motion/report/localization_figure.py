"""The figure of the omni demo: where the robot was, where it believed to be, and its errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.report import robot_drawing, style, wording
from agv_motion.report.figure import figure
from agv_motion.report.localization import ELLIPSE, OUTLIER, LocalizationRun

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.model.footprint import Footprint
    from agv_motion.report.stamped_columns import PoseColumns

    Array = NDArray[np.float64]

JUMP = 0.5
"""[m] that no robot drives in one step: it was carried; and nearer than that it is found again."""

BEFORE, AFTER = 15.0, 30.0
"""[s] before it was carried away and after it was found again that the map shows in full."""


class Carried(NamedTuple):
    """Somebody carried the robot away; times since the start of the drive [s]."""

    time: float
    found: float
    """when the pose was right again; NaN: never"""


def carried(run: LocalizationRun) -> Carried | None:
    """Return when the robot was carried away first, and when it had found itself again."""
    jumps = np.flatnonzero(np.hypot(*np.diff(run.truth.pose[:2])) > JUMP)
    if not len(jumps):
        return None
    time = float(run.truth.stamp[jumps[0] + 1])
    right = np.hypot(*run.error(run.pose)[:2]) < JUMP
    found = run.pose.stamp[right & (run.pose.stamp > time + 1.0)]
    return Carried(time, float(found[0]) if len(found) else float('nan'))


def finding(run: LocalizationRun) -> str:
    """Return what the drive was, in one line, from its numbers."""
    if not len(run.pose.stamp):
        return 'The robot never knew where it was'
    typical = float(np.median(np.hypot(*run.error(run.pose)[:2])))
    away = carried(run)
    said = f'The robot knows its place to {wording.length(typical)}'
    if away is None:
        return said
    if np.isnan(away.found):
        return f'{said}; carried away, it did not find itself again'
    return f'{said}; carried away, it finds itself again after {away.found - away.time:.0f} s'


def draw(
    run: LocalizationRun, path: Path, shape: Footprint | None = None, *, theme: str = 'light'
) -> None:
    """Draw path and ellipses, and errors over time, into one picture.

    Args:
        run: What was recorded.
        path: Of the picture.
        shape: What the robot covers of the floor; None: not known.
        theme: ``light`` or ``dark``.

    Raises:
        ConfigurationError: matplotlib is not installed.

    """
    mosaic: list[Any] = [['map', 'position'], ['map', 'heading']]
    with figure(
        path, mosaic, theme=theme, figsize=(style.WIDTH, 5.2), width_ratios=[1.15, 1]
    ) as axes:
        style.title(axes['map'], finding(run))
        _draw_map(axes['map'], run, shape)
        _draw_errors(axes['position'], axes['heading'], run)


def _window(run: LocalizationRun) -> tuple[float, float]:
    """Return from when to when the map shows all: the drive, or the time around being carried."""
    away = carried(run)
    if away is None:
        return 0.0, float(run.truth.stamp[-1])
    found = away.time if np.isnan(away.found) else away.found
    return away.time - BEFORE, found + AFTER


def _within(columns: PoseColumns, window: tuple[float, float]) -> PoseColumns:
    here = (columns.stamp >= window[0]) & (columns.stamp <= window[1])
    return type(columns)(columns.stamp[here], columns.pose[:, here], columns.covariance[:, here])


def without(columns: PoseColumns, part: PoseColumns) -> PoseColumns:
    """Return columns with NaN where a part of them is."""
    there = np.isin(columns.stamp, part.stamp)
    return columns._replace(pose=np.where(there, np.nan, columns.pose))


def _draw_map(axes: Any, run: LocalizationRun, shape: Footprint | None) -> None:
    window, away = _window(run), carried(run)
    truth, pose = _within(run.truth, window), _within(run.pose, window)
    axes.plot(*_broken(run.truth), lw=1.0, color=style.OTHERS[1], alpha=0.35)
    axes.plot(*_within(run.fix, window).pose[:2], '.', ms=4, color=style.OTHERS[1])
    axes.plot(*_broken(truth), lw=4.0, color=style.PATH, alpha=0.5)
    if away is not None:
        until = window[1] if np.isnan(away.found) else away.found - 1e-6
        astray = _within(run.pose, (away.time, until))
        axes.plot(*_broken(astray), lw=1.5, ls=(0, (3, 2)), color=style.GOAL)
        pose = without(pose, astray)
    axes.plot(*_broken(pose), lw=1.2, color=style.ROBOT)
    _draw_ellipses(axes, pose)
    style.direction(axes, np.array(_broken(truth)).T, style.PATH, 6)
    shown = np.concatenate([run.truth.pose[:2], pose.pose[:2]], axis=1)
    style.frame(axes, shown.T, 1.0)
    extent = float((np.nanmax(shown, axis=1) - np.nanmin(shown, axis=1)).max()) + 0.1
    shapes = robot_drawing.visible([shape] if shape else None, extent)
    _name_places(axes, run, window, shapes, extent)
    lost = '' if away is None else 'believed while lost (dashed), '
    axes.set_title(
        f'{max(window[0], 0.0):.0f} to {window[1]:.0f} s: way (green), pose believed, 95 % '
        f'ellipses (blue),\n{lost}fixes (dots), {robot_drawing.caption(shapes)}',
        fontsize=style.SMALL, fontweight='normal',
    )  # fmt: skip


def _name_places(
    axes: Any, run: LocalizationRun, window: tuple[float, float],
    shapes: Sequence[Footprint] | None, extent: float,
) -> None:  # fmt: skip
    """Draw the robot at start, end, and where it was carried from and to; name the places."""
    away = carried(run)
    ends = run.truth.pose[:2, [0, -1]].T
    at = {'start': 0.0, 'end': float(run.truth.stamp[-1])}
    if np.hypot(*(ends[1] - ends[0])) < robot_drawing.NEAR * extent:
        at = {'start and end': at['end']}
    if away is not None:
        at |= {'carried away': away.time - 0.2, 'set down': away.time + 0.2}
        at |= {} if np.isnan(away.found) else {'found again': away.found}
    way = _within(run.truth, window).pose[:2].T[::20]
    last = len(run.truth.stamp) - 1
    rows = {n: int(np.clip(np.searchsorted(run.truth.stamp, t), 0, last)) for n, t in at.items()}
    taken = [*way, *(run.truth.pose[:2, row] for row in rows.values())]
    for name, row in rows.items():
        place = run.truth.pose[:, row]
        robot_drawing.draw_robot(axes, place, shapes[0] if shapes else None, strong=True)
        distance = robot_drawing.beside(shapes, extent)
        style.name_near(axes, place[:2], distance, name, style.ink(), taken)


def _draw_ellipses(axes: Any, pose: PoseColumns) -> None:
    from matplotlib.patches import Ellipse

    step = max(len(pose.stamp) // 12, 1)
    for (x, y, _), (xx, xy, _, yy, _, _) in zip(
        pose.pose.T[::step], pose.covariance.T[::step], strict=True
    ):
        if np.isnan(x):
            continue
        values, vectors = np.linalg.eigh([[xx, xy], [xy, yy]])
        width, height = 2.0 * ELLIPSE * np.sqrt(np.maximum(values, 0.0))
        angle = np.degrees(np.arctan2(vectors[1, 0], vectors[0, 0]))
        axes.add_patch(
            Ellipse((x, y), width, height, angle=angle, fill=False, color=style.ROBOT, lw=0.8)
        )


def _draw_errors(position: Any, heading: Any, run: LocalizationRun) -> None:
    """Draw what pose and fixes err, and what the pose said it may."""
    fixes = np.hypot(*run.error(run.fix)[:2])
    position.plot(run.fix.stamp, fixes, '.', ms=2.5, color=style.OTHERS[1])
    if np.any(fixes < OUTLIER):
        style.line_label(position, float(np.median(fixes)), 'fixes', style.OTHERS[1])
    for of, colour, name in (
        (run.odometry_alone(), style.OTHERS[0], 'odometry alone'), (run.pose, style.ROBOT, 'pose'),
    ):  # fmt: skip
        wrong, gap = run.error(of), np.diff(of.stamp, append=of.stamp[-1:]) > 1.0
        for axes, values in (
            (position, np.hypot(*wrong[:2])), (heading, np.degrees(np.abs(wrong[2]))),
        ):  # fmt: skip
            axes.plot(*style.thinned(of.stamp, np.where(gap, np.nan, values)), color=colour, lw=1.0)
            if len(values):
                style.line_label(axes, max(float(values[-1]), 0.01), name, colour)
    xx, _, _, yy, _, tt = run.pose.covariance
    for axes, bound in (
        (position, ELLIPSE * np.sqrt(np.maximum(xx, yy))),
        (heading, 1.96 * np.degrees(np.sqrt(tt))),
    ):
        axes.fill_between(run.pose.stamp, 1e-4, bound, color=style.ROBOT, alpha=0.15, lw=0)
        if len(bound):
            style.line_label(axes, float(bound[-1]), '95 % of it, told', style.ROBOT)
        axes.set(yscale='log')
        axes.grid(visible=True, which='major')
    style.time_axis(heading, float(run.truth.stamp[-1]))
    position.sharex(heading)
    position.tick_params(labelbottom=False)
    position.set(ylabel='position error [m]', ylim=(3e-3, 20.0))
    heading.set(ylabel='heading error [°]', ylim=(3e-2, 200.0))
    away = carried(run)
    if away is not None:
        style.event(position, away.time, 'carried away', also=[heading])
        if not np.isnan(away.found):
            style.event(
                position, away.found, f'found again after {away.found - away.time:.0f} s',
                also=[heading],
            )  # fmt: skip


def _broken(columns: PoseColumns) -> tuple[Array, Array]:
    """Return x and y, not joined over a jump of more than half a metre in a step."""
    x, y, _ = columns.pose.copy()
    jumps = np.hypot(np.diff(x, append=x[-1:]), np.diff(y, append=y[-1:])) > JUMP
    x[jumps] = np.nan
    y[jumps] = np.nan
    return x, y
