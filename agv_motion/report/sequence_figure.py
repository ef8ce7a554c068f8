"""The figure of `agv sequence`: the way of each action on the map, and when it happens."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import style, wording
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.planar import Pose
    from agv_motion.sequence.prediction import Predicted

RIM = 0.04
"""of the extent of the map: so large the robot is drawn; a sequence does not tell its true size."""


def draw(
    name: str, start: Pose, predicted: list[Predicted], path: Path, *, theme: str = 'light'
) -> None:
    """Draw a predicted sequence into a picture.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    colours = [style.LINES[i % len(style.LINES)] for i in range(len(predicted))]
    with figure(
        path, [['map', 'times']], theme=theme, figsize=(style.WIDTH, 5.0), width_ratios=[1, 1.1]
    ) as axes:
        style.title(axes['map'], finding(name, predicted))
        _draw_map(axes['map'], start, predicted, colours)
        _draw_times(axes['times'], predicted, colours)


def finding(name: str, predicted: list[Predicted]) -> str:
    """Return what the sequence will be, in one line, from its numbers."""
    last, late = predicted[-1], [each for each in predicted if each.warning]
    way = sum(each.length for each in predicted)
    told = f'{len(late)} will take too long' if late else 'each within its timeout'
    return (
        f'{name}: {wording.in_words(len(predicted))} actions, {way:.1f} m in '
        f'{last.begin + last.duration:.0f} s, {told}'
    )


def _draw_map(axes: Any, start: Pose, predicted: list[Predicted], colours: list[Any]) -> None:
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
             if np.hypot(pose.x - each.end.x, pose.y - each.end.y) < RIM * extent), None,
        )  # fmt: skip
        if at is None:
            places.append((each.end, f'{i + 1}', colour))
        else:
            places[at] = (each.end, f'{places[at][1]}, {i + 1}', colour)
    taken = [*np.concatenate(ways)[::5], *(np.array(pose[:2]) for pose, *_ in places)]
    style.frame(axes, np.concatenate(ways), 0.12 * extent)
    for pose, number, colour in places:
        style.robot(axes, pose, RIM * extent, colour, strong=True)
        style.name_near(axes, pose[:2], 1.8 * RIM * extent, number, colour, taken)


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
        yticklabels=[f'{i} {e.step.name.strip()}' for i, e in zip(rows, predicted, strict=True)],
        title='When each action runs, and its timeout',
    )  # fmt: skip
    axes.tick_params(axis='y', length=0)
    axes.spines['left'].set_visible(False)
    axes.invert_yaxis()
