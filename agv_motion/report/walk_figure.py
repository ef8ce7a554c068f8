"""The walk of a tree in one figure: zone, memory, trail and goals; probes, wheels, residual."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.model.footprint import disc
from agv_motion.report import robot_drawing, style, wording
from agv_motion.report.figure import figure
from agv_motion.report.litres import in_litres
from agv_motion.report.recorded_footprint import moments

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.motion.navigation.zone import Zone
    from agv_motion.report.walk import WalkRun

GOALS_LISTED = 12
"""Goals that the figure has room for, the latest."""

LONGEST_REASON = 32
"""Characters of a reason that the figure has room for"""

ROOM = 0.4
"""of the time: a shorter one beside a bar has no room for a reason."""

STILL = 0.05
"""[m] A tree that went no further has stood."""

FELT = 0.01
"""[-] Change of the sap flow from which on it is called sun or shade."""


class WalkLimits(NamedTuple):
    """What the walk is measured by."""

    wheel_speed: float
    """[m/s] most that a wheel may do"""
    residual: float = 0.02
    """[m/s] at which the wheels are stopped"""
    rim: float = PLATFORM_RADIUS
    """[m] how far the platform reaches from its centre; it is drawn at its true size"""


def draw(  # noqa: PLR0913 - a picture, each with its own name
    run: WalkRun, zone: Zone, limits: WalkLimits, path: Path, *, days: float = 0.0,
    theme: str = 'light',
) -> None:  # fmt: skip
    """Draw zone and trail, goals, probes and wheel speeds into one picture.

    Args:
        run: What was recorded.
        zone: Where the tree walked.
        limits: Of wheels and residual, and the rim.
        path: Of the picture.
        days: How many days of recorded probes were played; 0: the probes were simulated.
        theme: ``light`` or ``dark``.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    rows = {'goals': 2.4, 'flow': 1.0, 'water': 1.0, 'speed': 1.0}
    if run.water is None:
        del rows['water']
    mosaic: list[Any] = [['map', name] for name in rows]
    with figure(
        path, mosaic, theme=theme, figsize=(style.WIDTH, 5.9 if run.water is None else 7.0),
        width_ratios=[1.35, 1], height_ratios=[*rows.values()],
    ) as axes:  # fmt: skip
        style.title(axes['map'], finding(run, zone, limits.rim, days))
        _draw_map(axes['map'], run, zone, limits.rim)
        _draw_goals(axes['goals'], run, days)
        _draw_flow(axes['flow'], run, days)
        if run.water is not None:
            _draw_water(axes['water'], run, days)
        _draw_speeds(axes['speed'], run, limits, days)


def finding(run: WalkRun, zone: Zone, rim: float, days: float = 0.0) -> str:
    """Return what the walk was, in one line, from its numbers."""
    if not len(run.path):
        return 'Nothing was recorded of the walk'
    still = run.distance() < STILL
    walked = 'stands' if still else wording.counted(run.distance(), 'metre')
    said = [
        f'{walked} {"for" if still else "in"} {wording.span_in_words(run.path[-1, 0])}'
        + (f' that played {wording.counted(days, "day")}' if days else ''),
        *([] if days or still else towards(run)),
    ]
    near = run.nearest_edge(zone, rim)
    inside = f'never nearer than {near:.1f} m to the edge'
    said.append(inside if near > 0.0 else f'{-near:.1f} m over the edge at worst')
    return wording.sentence(', '.join(said))


def towards(run: WalkRun) -> list[str]:
    """Return whether the way led to the sun or the shade, where the sap flow tells."""
    third = len(run.flow) // 3
    if not third:
        return []
    gained = float(run.flow[-third:, 3].mean() - run.flow[:third, 3].mean())
    if abs(gained) < FELT:
        return []
    return ['towards the sun' if gained > 0.0 else 'into the shade']


def _seconds(run: WalkRun) -> float:
    ends = [part[-1, 0] for part in (run.path, run.flow, run.speeds) if len(part)]
    return float(max(ends, default=1.0))


def _draw_map(axes: Any, run: WalkRun, zone: Zone, rim: float) -> None:
    """Draw the floor, its margin, and the memory, the trail and the goals."""
    for area in zone.translation_only:
        axes.fill(*np.array(area.exterior.coords).T, color=style.HINDERED, alpha=0.2, lw=0)
    _draw_memory(axes, run)
    style.zone(axes, zone.floor, zone.parts)
    west, _, _, north = zone.parts[0].bounds
    axes.annotate(
        'the centre stays within', (west, north), xytext=(0, 3), textcoords='offset points',
        fontsize=style.SMALL,
    )  # fmt: skip
    if len(run.path):
        place = run.path[:, 1:3]
        axes.plot(*place.T, color=style.PATH, lw=1.6)
        style.direction(axes, place, style.PATH)
        rows = moments(len(run.path))
        shapes = run.footprints or [disc(rim)] * len(rows)
        robot_drawing.draw_way(axes, run.path[rows, 1:], shapes)
        _name_ends(axes, run, rim)
    for x, y, names in style.grouped(run.goals[:, 1:], DISC):
        style.number(axes, x, y, names)


def _draw_memory(axes: Any, run: WalkRun) -> None:
    """Draw where the tree was, and what it felt there: from shade to sun, over its own range."""
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap

    if run.visited is not None:
        axes.pcolormesh(
            run.visited.x, run.visited.y, 0.0 * run.visited.values, alpha=0.15, lw=0,
            cmap=ListedColormap([style.faint()]), rasterized=True,
        )  # fmt: skip
    if run.felt is None or np.isnan(run.felt.values).all():
        return
    light = LinearSegmentedColormap.from_list('light', [style.SHADE, style.SUN])
    felt = axes.pcolormesh(
        run.felt.x, run.felt.y, run.felt.values / 100.0, cmap=light, rasterized=True
    )
    bar = axes.figure.colorbar(
        felt, cax=axes.inset_axes((0.2, -0.2, 0.6, 0.025)), orientation='horizontal',
        label='sap flow remembered, from shade to sun',
    )  # fmt: skip
    bar.outline.set_visible(False)


def _name_ends(axes: Any, run: WalkRun, rim: float) -> None:
    """Name start and end beside their platforms, where most room is."""
    rows = np.linspace(0, len(run.path) - 1, 50).astype(int)
    taken = [*run.path[rows, 1:3], *run.goals[:, 1:3]]
    ends = run.path[[0, -1], 1:3]
    together = np.hypot(*(ends[1] - ends[0])) < robot_drawing.OVERLAP * rim
    for row, name in ((-1, 'start and end'),) if together else ((0, 'start'), (-1, 'end')):
        style.name_near(axes, ends[row], 1.2 * rim, name, style.ROBOT, taken)


DISC = 0.9
"""[m] that a numbered disc takes on the map: goals nearer than that share one."""


def _draw_goals(axes: Any, run: WalkRun, days: float) -> None:
    """Draw when the tree set out for each goal, its number and why, one row a goal."""
    seconds = _seconds(run)
    scaled = style.time_axis(axes, seconds, days)
    first = max(len(run.goals) - GOALS_LISTED, 0)
    rows = list(zip(run.goals, run.reasons, strict=True))[first:]
    ends = [*(goal[0] for goal, _ in rows[1:]), seconds][: len(rows)]
    for row, ((goal, reason), end) in enumerate(zip(rows, ends, strict=True)):
        begin = float(scaled(goal[0]))
        axes.barh(row, scaled(end) - begin, left=begin, height=0.3, color=style.PATH)
        style.number(axes, begin, row, f'{first + row + 1}')
        before, after = goal[0] / seconds, 1.0 - end / seconds
        late = before > after
        if max(before, after) > ROOM:  # beside the bar, where most room is
            place, aside = (begin if late else scaled(end), row), (-10 if late else 6, 0)
        else:
            late, place, aside = False, (begin, row), (10, 8)
        axes.annotate(
            _short(reason), place, xytext=aside, textcoords='offset points', va='center',
            ha='right' if late else 'left', fontsize=style.SMALL,
        ).set_in_layout(False)  # fmt: skip
    told = 'Goals and their reasons' if rows else 'No goal was set'
    if first:
        told = f'The last {len(rows)} of {len(run.goals)} goals'
    axes.set(title=told, yticks=[], xlabel='',
             ylim=(max(len(rows), 8) - 0.4, -0.6))  # fmt: skip
    axes.spines['left'].set_visible(False)
    axes.tick_params(labelbottom=False)


def _short(reason: str) -> str:
    """Return a reason without its place, which the map shows, nor when it was felt."""
    words = reason.partition(' at (')[0].partition(': (')[0].replace('remembered ', '')
    return wording.clipped(words, LONGEST_REASON)


def _draw_flow(axes: Any, run: WalkRun, days: float) -> None:
    scaled = style.time_axis(axes, _seconds(run), days)
    probes = {'s1 speed': style.ROBOT, 's2 rotation': style.OTHERS[0], 's3 places': style.SUN}
    for i, (name, colour) in enumerate(probes.items()):
        axes.plot(*style.thinned(scaled(run.flow[:, 0]), run.flow[:, 1 + i]), color=colour)
        if len(run.flow):
            style.line_label(axes, run.flow[-1, 1 + i], name, style.ink())
    style.scale(axes, run.flow[:, 1:], least=0.05)
    axes.set(title='Sap flow', ylabel='of the most [-]', xlabel='')
    axes.tick_params(labelbottom=False)


def _draw_water(axes: Any, run: WalkRun, days: float) -> None:
    """Draw what it drank since each midnight, in its interval."""
    scaled = style.time_axis(axes, _seconds(run), days)
    water = run.water if run.water is not None else np.empty((0, 4))
    midnights = np.flatnonzero(np.diff(water[:, 1]) < 0.0) + 1
    time, *litres = np.insert(water, midnights, np.nan, axis=0).T
    value, low, high = litres
    axes.fill_between(scaled(time), low, high, color=style.WAITING, alpha=0.2, lw=0)
    axes.plot(*style.thinned(scaled(time), value), color=style.ROBOT)
    style.line_label(axes, high[-1], '95 %', style.ink())
    last = run.drunk().since_midnight()
    told = '' if last is None else f': {in_litres(last)} today'
    axes.set(title=f'Drank{told}', ylabel='[L]', xlabel='', ylim=(0.0, None))
    axes.tick_params(labelbottom=False)


def _draw_speeds(axes: Any, run: WalkRun, limits: WalkLimits, days: float) -> None:
    """Draw the speed of each wheel; the limit as a line where it is near, else in words."""
    scaled = style.time_axis(axes, _seconds(run), days)
    speeds = 60.0 * run.speeds[:, 1:]
    for i, colour in zip(range(speeds.shape[1]), style.LINES, strict=False):
        axes.plot(*style.thinned(scaled(run.speeds[:, 0]), speeds[:, i]), color=colour, lw=1.0)
        if len(speeds):
            style.line_label(axes, speeds[-1, i], f'turret {i}', colour)
    top = float(np.abs(speeds).max(initial=0.0))
    worst = 1e3 * float(run.residual[:, 1].max(initial=0.0))
    style.scale(axes, speeds, least=0.1)
    axes.set(ylabel='[m/min]', title=f'Wheels: at most {top:.2f} m/min, limit '
             f'{60.0 * limits.wheel_speed:.3g}')  # fmt: skip
    axes.set_xlabel(
        f'{axes.get_xlabel()}\nresidual of the turrets at most {worst:.2f} mm/s, limit '
        f'{1e3 * limits.residual:g}'
    )
