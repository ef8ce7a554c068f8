"""The figure of `agv sequence`: the way of each action on the map, and when it happens."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import robot_drawing, style, wording
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.model.footprint import Footprint
    from agv_motion.planar import Pose
    from agv_motion.sequence.prediction import Predicted

LONGEST_NAME = 32
"""Characters of an action that the figure has room for"""

FEWEST_ROWS = 4
"""There is room for so many actions, at least: the bar of one alone is no wall."""


def draw(  # noqa: PLR0913 - a picture, each with its own name
    name: str, start: Pose, predicted: list[Predicted], path: Path,
    shape: Footprint | None = None, *, theme: str = 'light',
) -> None:  # fmt: skip
    """Draw a predicted sequence into a picture.

    Args:
        name: Of the sequence.
        start: Where it begins.
        predicted: Each action, and what becomes of it.
        path: Of the picture.
        shape: What the robot covers of the floor; None: not known.
        theme: ``light`` or ``dark``.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    colours = [style.LINES[i % len(style.LINES)] for i in range(len(predicted))]
    size = style.WIDTH, 5.0 + 0.16 * max(len(predicted) - 20, 0)
    with figure(path, [['map', 'times']], theme=theme, figsize=size, width_ratios=[1, 1.1]) as axes:
        style.title(axes['map'], finding(name, predicted))
        _draw_map(axes['map'], start, predicted, colours, shape)
        _draw_times(axes['times'], predicted, colours)


def finding(name: str, predicted: list[Predicted]) -> str:
    """Return what the sequence will be, in one line, from its numbers."""
    last, late = predicted[-1], [each for each in predicted if each.warning]
    way = sum(each.length for each in predicted)
    told = f'{len(late)} will take too long' if late else 'each within its timeout'
    return (
        f'{name}: {wording.counted(len(predicted), "action")}, {way:.1f} m in '
        f'{last.begin + last.duration:.0f} s, {told}'
    )


def _draw_map(
    axes: Any, start: Pose, predicted: list[Predicted], colours: list[Any], shape: Footprint | None
) -> None:
    """Draw the ways, and where each action ends with its number; those that end at one place."""
    ways = [np.array([pose[:2] for pose in each.poses]) for each in predicted]
    extent = float(np.ptp(np.concatenate(ways), axis=0).max()) + 0.1
    for way, colour in zip(ways, colours, strict=True):
        axes.plot(*way.T, color=colour, lw=2)
        if np.hypot(*np.diff(way, axis=0).T).sum() > 0.1 * extent:
            style.direction(axes, way, colour, 1)
    places: list[tuple[Pose, str, Any]] = [(start, 'start', style.ink())]
    for i, (each, colour) in enumerate(zip(predicted, colours, strict=True)):
        at = next(
            (k for k, (pose, *_) in enumerate(places)
             if np.hypot(pose.x - each.end.x, pose.y - each.end.y) < robot_drawing.NEAR * extent),
            None,
        )  # fmt: skip
        if at is None:
            places.append((each.end, f'{i + 1}', colour))
        else:
            places[at] = (each.end, f'{places[at][1]}, {i + 1}', colour)
    taken = [*np.concatenate(ways)[::5], *(np.array(pose[:2]) for pose, *_ in places)]
    shapes = robot_drawing.visible([shape] if shape else None, extent)
    style.frame(axes, np.concatenate(ways), robot_drawing.room(shapes, extent))
    for pose, number, colour in places:
        robot_drawing.draw_robot(axes, pose, shapes[0] if shapes else None, colour, strong=True)
        distance = robot_drawing.beside(shapes, extent)
        style.name_near(axes, pose[:2], distance, number, style.ink(), taken)
    axes.set_title(robot_drawing.caption(shapes), fontsize=style.SMALL, fontweight='normal')


def _draw_times(axes: Any, predicted: list[Predicted], colours: list[Any]) -> None:
    """Draw one bar an action, in its colour, its duration beside it and how long it may take."""
    rows = range(1, len(predicted) + 1)
    end = predicted[-1].begin + predicted[-1].duration
    for row, each, colour in zip(rows, predicted, colours, strict=True):
        axes.barh(row, each.duration, left=each.begin, height=0.35, color=colour)
        late = each.begin + 0.5 * each.duration > 0.5 * end
        axes.annotate(
            f'{each.duration:.1f} s, at most {each.step.timeout:g}',
            (each.begin if late else each.begin + each.duration, row),
            xytext=(-5 if late else 5, 0), textcoords='offset points', va='center',
            ha='right' if late else 'left', fontsize=style.SMALL,
            color=style.GOAL if each.warning else style.ink(),
        )  # fmt: skip
    axes.set(
        yticks=list(rows), xlabel='time [s]', xlim=(0.0, end + 1e-3),
        yticklabels=[
            wording.clipped(f'{i} {each.step.name.strip()}', LONGEST_NAME)
            for i, each in zip(rows, predicted, strict=True)
        ],
        ylim=(max(len(predicted), FEWEST_ROWS) + 0.6, 0.4),
        title='When each action runs, and its timeout',
    )  # fmt: skip
    axes.tick_params(axis='y', length=0)
    axes.spines['left'].set_visible(False)
