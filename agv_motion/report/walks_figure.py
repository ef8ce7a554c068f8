"""The figure of several trees: their ways and goals, the gaps between them, what each did when."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.model.footprint import disc
from agv_motion.report import robot_drawing, style, wording
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

MOST_GAPS = 6
"""Lines of gaps that are named; of more the least of all is drawn over them."""

MOST_GOALS = 30
"""Goals of all trees on the map; of more the latest of each."""

MARGIN = 0.9
"""[m] Nearer than that to each other, goals share a disc on the map."""


def finding(walks: Sequence[RecordedWalk], traffic: TrafficParameters) -> str:
    """Return what the walks were, in one line, from their numbers."""
    walked = sum(walk.distance() for walk in walks)
    seconds = max(float(walk.time[-1]) for walk in walks)
    trees = 'tree walks' if len(walks) == 1 else 'trees walk'
    said = (
        f'{wording.in_words(len(walks))} {trees} {wording.counted(walked, "metre")} in '
        f'{wording.span_in_words(seconds)}'
    )
    _, between = gaps(walks, traffic.body)
    near = min((float(gap.min()) for gap in between.values() if len(gap)), default=np.inf)
    if np.isinf(near):
        return wording.sentence(said)
    if near < 0.0:
        return wording.sentence(f'{said}, two of them {-near:.1f} m into each other at worst')
    return wording.sentence(f'{said}, never nearer than {near:.1f} m to each other')


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
    size = style.WIDTH, 4.9 + 0.3 * max(len(walks) - 4, 0)
    heights = [1.0, max(1.0, 0.25 * len(walks))]
    with figure(
        path, mosaic, theme=theme, figsize=size, width_ratios=[1.35, 1], height_ratios=heights
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
            pose, shape = [*way[row], walk.heading[row]], (walk.footprints or [disc(body)])[row]
            robot_drawing.draw_robot(axes, pose, shape, colour_of(i), strong=row < 0)
            said = wording.clipped(name, 18)
            style.name_near(axes, way[row], 1.2 * body, said, colour_of(i), taken)
        latest = max(MOST_GOALS // len(walks), 1)
        first = max(len(walk.goals) - latest, 0)
        for x, y, names in style.grouped([goal[1:] for goal in walk.goals], MARGIN, first):
            style.number(axes, x, y, names, colour_of(i))


def _draw_gaps(axes: Any, walks: Sequence[RecordedWalk], traffic: TrafficParameters) -> None:
    """Draw the gap of each two trees, in the colours of both."""
    times, between = gaps(walks, traffic.body)
    scaled = style.time_axis(axes, float(max(w.time[-1] for w in walks)))
    colours = {walk.name: colour_of(i) for i, walk in enumerate(walks)}
    many = len(between) > MOST_GAPS
    for pair, gap in between.items():
        one, _, other = pair.partition(' and ')
        axes.plot(scaled(times), gap, color=colours[one], lw=0.5 if many else 1.6)
        if len(gap) and not many:
            axes.plot(scaled(times), gap, color=colours[other], lw=1.6, ls=(0, (4, 4)))
            names = f'{wording.clipped(one, 12)}, {wording.clipped(other, 12)}'
            style.line_label(axes, float(gap[-1]), names, style.ink())
    if many:
        nearest = np.min([*between.values()], axis=0)
        axes.plot(scaled(times), nearest, color=style.ink(), lw=1.8)
        style.line_label(axes, float(nearest[-1]), 'nearest two', style.ink())
    known = [gap for gap in between.values() if len(gap)]
    top = max((float(gap.max()) for gap in known), default=1.0)
    bottom = min((float(gap.min()) for gap in known), default=0.0)
    axes.set(ylim=(1.08 * min(bottom, 0.0), 1.08 * top), xlabel='', ylabel='rim to rim [m]',
             title='Gaps' if known else 'Gaps: one tree alone')  # fmt: skip
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
    axes.set_yticks(range(len(walks)), [wording.clipped(walk.name, 18) for walk in walks])
    axes.set(ylim=(len(walks) - 0.6, -0.7), title='What each does; the numbers are its goals')
    axes.tick_params(axis='y', length=0)
    axes.spines['left'].set_visible(False)
    axes.figure.legend(
        handles=[Patch(color=SHADES[what], label=what) for what in DOINGS], ncols=len(DOINGS),
        loc='outside lower right', handlelength=1.0,
    )  # fmt: skip
