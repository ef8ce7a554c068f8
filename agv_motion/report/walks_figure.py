"""The figure of several trees: their ways and goals, the gaps between them, what each did when."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import style, wording
from agv_motion.report.figure import figure
from agv_motion.report.walks import DOINGS, RecordedWalk, gaps

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
    from agv_motion.motion.navigation.zone import Zone

TREES = (style.ROBOT, *style.OTHERS)
"""Colours of the trees, again from the first where there are more."""

SHADES = {
    'walks': style.PATH, 'gives way': style.HINDERED, 'waits': style.WAITING, 'rests': '#CFCFCF',
}  # fmt: skip
"""Colours of all `DOINGS`."""

MARGIN = 0.9
"""[m] Nearer than that to each other, goals share a disc on the map."""


def finding(walks: Sequence[RecordedWalk], traffic: TrafficParameters) -> str:
    """Return what the walks were, in one line, from their numbers."""
    walked = sum(walk.distance() for walk in walks)
    seconds = max(float(walk.time[-1]) for walk in walks)
    said = (
        f'{wording.in_words(len(walks))} trees walk {wording.in_words(walked)} metres in '
        f'{wording.span_in_words(seconds)}'
    )
    _, between = gaps(walks, traffic.body)
    near = min((float(gap.min()) for gap in between.values() if len(gap)), default=np.inf)
    return wording.sentence(
        said if np.isinf(near) else f'{said}, never nearer than {near:.1f} m to each other'
    )


def draw(
    walks: Sequence[RecordedWalk], zone: Zone, traffic: TrafficParameters, path: Path, *,
    theme: str = 'light',
) -> None:  # fmt: skip
    """Draw the walks, the gaps between the trees, and what each did when, into one picture.

    Raises:
        ConfigurationError: matplotlib is not installed.
        SourceError: The file cannot be written.

    """
    mosaic: list[Any] = [['map', 'gaps'], ['map', 'doings']]
    with figure(
        path, mosaic, theme=theme, figsize=(style.WIDTH, 4.9), width_ratios=[1.35, 1]
    ) as axes:
        style.title(axes['map'], finding(walks, traffic))
        _draw_map(axes['map'], walks, zone, traffic.body)
        _draw_gaps(axes['gaps'], walks, traffic)
        _draw_doings(axes['doings'], walks)


def colour_of(tree: int) -> str:
    """Return the colour of a tree by its place in the list."""
    return TREES[tree % len(TREES)]


def _draw_map(axes: Any, walks: Sequence[RecordedWalk], zone: Zone, body: float) -> None:
    """Draw the floor, the ways with numbered goals, and the trees at start and end."""
    style.zone(axes, zone.floor, zone.parts)
    taken = [walk.path[:, row] for walk in walks for row in range(0, len(walk.time), 50)]
    taken += [np.array(goal[1:]) for walk in walks for goal in walk.goals]
    for i, walk in enumerate(walks):
        way = walk.path.T
        axes.plot(*walk.path, lw=1.5, color=colour_of(i))
        style.direction(axes, way, colour_of(i), 3)
        for row, name in ((0, 'start'), (-1, walk.name)):
            style.robot(axes, _looking(way, row), body, colour_of(i), strong=row < 0)
            style.name_near(axes, way[row], 1.2 * body, name, colour_of(i), taken)
        for x, y, names in style.grouped([goal[1:] for goal in walk.goals], MARGIN):
            style.number(axes, x, y, names, colour_of(i))


def _looking(way: Any, row: int) -> list[float]:
    """Return the place at the start (0) or the end (-1) of a way and where it led just there."""
    moved = np.flatnonzero(np.hypot(*(way - way[row]).T) > 0.05)
    if not len(moved):
        return [*way[row], 0.0]
    there = way[moved[0]] - way[0] if row == 0 else way[-1] - way[moved[-1]]
    return [*way[row], float(np.arctan2(there[1], there[0]))]


def _draw_gaps(axes: Any, walks: Sequence[RecordedWalk], traffic: TrafficParameters) -> None:
    """Draw the gap of each two trees, in the colours of both."""
    times, between = gaps(walks, traffic.body)
    scaled = style.time_axis(axes, float(max(w.time[-1] for w in walks)))
    colours = {walk.name: colour_of(i) for i, walk in enumerate(walks)}
    for pair, gap in between.items():
        one, _, other = pair.partition(' and ')
        axes.plot(scaled(times), gap, color=colours[one], lw=1.6)
        axes.plot(scaled(times), gap, color=colours[other], lw=1.6, ls=(0, (4, 4)))
        if len(gap):
            style.line_label(axes, float(gap[-1]), f'{one}, {other}', style.ink())
    top = max((float(gap.max()) for gap in between.values() if len(gap)), default=1.0)
    axes.set(ylim=(0.0, 1.08 * top), xlabel='', ylabel='rim to rim [m]', title='Gaps')
    style.limit(axes, traffic.margin, f'least {traffic.margin:g} m')
    axes.tick_params(labelbottom=False)


def _draw_doings(axes: Any, walks: Sequence[RecordedWalk]) -> None:
    """Draw what each tree did, and when it set out for which of its goals."""
    from matplotlib.patches import Patch

    scaled = style.time_axis(axes, float(max(w.time[-1] for w in walks)))
    for i, walk in enumerate(walks):
        for begin, length, what in walk.spans():
            axes.barh(i, scaled(length), left=scaled(begin), color=SHADES[what], height=0.4)
        for k, goal in enumerate(walk.goals):
            style.number(axes, scaled(goal[0]), i - 0.36, f'{k + 1}', colour_of(i))
    axes.set_yticks(range(len(walks)), [walk.name for walk in walks])
    axes.set(ylim=(len(walks) - 0.6, -0.7), title='What each does; the numbers are its goals')
    axes.tick_params(axis='y', length=0)
    axes.spines['left'].set_visible(False)
    axes.legend(
        handles=[Patch(color=SHADES[what], label=what) for what in DOINGS], ncols=len(DOINGS),
        loc='upper center', bbox_to_anchor=(0.5, -0.3), handlelength=1.0,
    )  # fmt: skip
