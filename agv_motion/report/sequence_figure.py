"""The figure of `agv sequence --dry-run`: the way of each action, and when it happens."""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.planar import Pose
    from agv_motion.sequence.prediction import Predicted


def draw(name: str, start: Pose, predicted: list[Predicted], path: Path) -> None:
    """Draw a predicted sequence into a picture.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    import matplotlib as mpl

    colours = [mpl.colormaps['tab10'](i % 10) for i in range(len(predicted))]
    with figure(path, [['map', 'times']], figsize=(13, 6.5), width_ratios=[1.1, 1]) as axes:
        _draw_map(axes['map'], start, predicted, colours)
        _draw_times(axes['times'], predicted, colours)
        last = predicted[-1]
        axes['map'].set_title(f'{name}: {last.begin + last.duration:.1f} s')


def _draw_map(axes: Any, start: Pose, predicted: list[Predicted], colours: list[Any]) -> None:
    extent = np.ptp([pose[:2] for each in predicted for pose in each.poses], axis=0).max()
    arrow = 0.05 * extent + 0.02
    for each, colour in zip(predicted, colours, strict=True):
        axes.plot(*np.array([pose[:2] for pose in each.poses]).T, color=colour, lw=2)
    for i, pose in enumerate([start, *(each.end for each in predicted)]):
        colour = colours[i - 1] if i else 'k'
        axes.annotate(
            '', (pose.x + arrow * cos(pose.theta), pose.y + arrow * sin(pose.theta)), pose[:2],
            arrowprops={'arrowstyle': '-|>', 'color': colour, 'lw': 1.5},
        )  # fmt: skip
        axes.plot(*pose[:2], 'o', ms=4, color=colour)
        axes.annotate(
            str(i) if i else 'start', pose[:2], textcoords='offset points',
            xytext=(5, -11 + 9 * (i % 3)), color=colour,
        )  # fmt: skip
    axes.set(aspect='equal', adjustable='datalim', xlabel='x [m]', ylabel='y [m]')


def _draw_times(axes: Any, predicted: list[Predicted], colours: list[Any]) -> None:
    """Draw one bar an action, and how long it may take at most."""
    rows = range(1, len(predicted) + 1)
    begins = [each.begin for each in predicted]
    axes.barh(
        rows, [each.step.timeout for each in predicted], left=begins, height=0.25, color='0.9',
        label='allowed by the timeout',
    )  # fmt: skip
    axes.barh(rows, [each.duration for each in predicted], left=begins, height=0.6, color=colours)
    axes.set(
        yticks=list(rows),
        yticklabels=[f'{i} {e.step.name}' for i, e in zip(rows, predicted, strict=True)],
    )
    end = predicted[-1].begin + predicted[-1].duration
    axes.set(xlabel='time [s]', xlim=(0.0, 1.15 * end + 1e-3))
    axes.invert_yaxis()
    axes.legend(fontsize='small')
