"""The figure of a season: how much of its floor a tree has stood on, by two choices of goals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.report import style, wording
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

BESIDE = 3
"""Floors in a row of the picture"""

WHOLE = 0.99
"""Share of a floor from which it counts as all of it"""


class FloorCoverage(NamedTuple):
    """Shares of one floor that were stood on at the end of each day, a row for each season."""

    memory: Sequence[Sequence[float]]
    """where the tree goes by memory, the shortest way"""
    straight: Sequence[Sequence[float]]
    """where it goes straight or not at all"""


def finding(floors: Mapping[str, FloorCoverage]) -> str:
    """Return what the seasons showed, in one line, from their numbers."""
    slowest = max(_day_of_all(row) for floor in floors.values() for row in floor.memory)
    least = min(row[-1] for floor in floors.values() for row in floor.straight)
    days = f'within {wording.counted(slowest, "day")}' if np.isfinite(slowest) else 'not in time'
    return wording.sentence(
        f'by memory a tree comes to all of its floor {days}; straight or not at all, '
        f'once to {100.0 * least:.0f} % of it'
    )


def draw(floors: Mapping[str, FloorCoverage], path: Path, *, theme: str = 'light') -> None:
    """Draw the shares over the days, a picture for each floor, beside each other.

    Raises:
        ConfigurationError: matplotlib is not installed.
        SourceError: The file cannot be written.

    """
    names = list(floors)
    rows = [names[i : i + BESIDE] for i in range(0, len(names), BESIDE)]
    mosaic = [[*row, *['.'] * (len(rows[0]) - len(row))] for row in rows]
    size = style.WIDTH, 0.6 + 3.0 * len(rows)
    with figure(path, mosaic, theme=theme, figsize=size, sharey=True) as axes:
        style.title(
            axes[names[0]],
            finding(floors),
            'Each line is one season: the share of the floor stood on by the end of each day',
        )
        for name in names:
            _draw_floor(axes[name], name, floors[name])
        for row in rows:
            axes[row[0]].set(ylabel='floor stood on [%]')


def _draw_floor(axes: Any, name: str, floor: FloorCoverage) -> None:
    """Draw one floor: straight in broad lines below, memory in thin ones on top."""
    below, above = style.OTHERS[0], style.ROBOT
    for rows, color, width in ((floor.straight, below, 3.2), (floor.memory, above, 1.3)):
        for row in rows:
            axes.plot(100.0 * np.asarray(row), color=color, lw=width, solid_joinstyle='round')
    days = len(floor.memory[0]) - 1
    axes.set(title=name, xlabel='day', xlim=(0, days), ylim=(0, 104))
    axes.xaxis.get_major_locator().set_params(integer=True, nbins=5)
    axes.grid(axis='y')
    axes.text(0.97, 0.14, 'by memory', color=above, ha='right', transform=axes.transAxes)
    axes.text(
        0.97, 0.05, 'straight or not at all', color=below, ha='right',
        transform=axes.transAxes,
    )  # fmt: skip


def _day_of_all(row: Sequence[float]) -> float:
    """Return the first day at whose end all of the floor had been stood on; infinity: none."""
    whole = np.flatnonzero(np.asarray(row) >= WHOLE)
    return float(whole[0]) if len(whole) else np.inf
