"""The figure of `agv route`: the way driven on the route, and what holds the speed down."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import robot_drawing, style
from agv_motion.report.figure import figure
from agv_motion.report.recorded_footprint import moments
from agv_motion.route.prediction import NOTHING
from agv_motion.route.speeds import RouteLimiter

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.model.footprint import Footprint
    from agv_motion.route.prediction import Prediction
    from agv_motion.route.route import Route

HOLDERS = {
    NOTHING: ('at top speed', style.ROBOT),
    RouteLimiter.TO_GO.value: ('the end is near', style.GOAL),
    RouteLimiter.HEADING.value: ('turns towards the virtual point', style.HINDERED),
    RouteLimiter.WAYPOINT.value: ('a waypoint is near', style.OTHERS[0]),
    RouteLimiter.BEND.value: ('a bend is near', style.OTHERS[2]),
    RouteLimiter.COUPLING.value: ('gathers speed', style.WAITING),
}
"""What each that holds the speed down is in words, and its colour."""


def draw(
    route: Route, run: Prediction, path: Path, shape: Footprint | None = None, *,
    theme: str = 'light',
) -> None:  # fmt: skip
    """Draw ``run`` on ``route`` into a picture.

    Args:
        route: What is to be followed.
        run: How it is.
        path: Of the picture.
        shape: What the robot covers of the floor; None: not known.
        theme: ``light`` or ``dark``.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    mosaic: list[Any] = [['map', 'speed'], ['map', 'turn']]
    with figure(
        path, mosaic, theme=theme, figsize=(style.WIDTH, 5.4), width_ratios=[1, 1.1]
    ) as axes:
        style.title(axes['map'], finding(run))
        _draw_map(axes['map'], route, run, shape)
        _draw_time(axes, run)


def finding(run: Prediction) -> str:
    """Return what the drive will be, in one line, from its numbers."""
    place = np.array([pose[:2] for pose in run.poses])
    way = float(np.hypot(*np.diff(place, axis=0).T).sum())
    held = run.held_by()
    free = sum(holder == NOTHING for holder in held) / max(len(held), 1)
    return (
        f'{way:.1f} m in {run.dt * len(run.steps):.0f} s, {100.0 * free:.0f} % of it at top speed'
    )


def _draw_map(axes: Any, route: Route, run: Prediction, shape: Footprint | None) -> None:
    """Draw the route, the way on it in the colour of what holds the speed down, and both ends."""
    from matplotlib.lines import Line2D

    points = np.array(route.waypoints)
    axes.plot(*points.T, 'o-', color=style.OTHERS[1], alpha=0.35, lw=5, ms=7)
    place = np.array([pose[:2] for pose in run.poses])
    style.direction(axes, place, style.ink(), 5)
    keys = []
    for holder, here in _held(run):
        word, colour = HOLDERS[holder]
        axes.plot(*np.where(here[:, None], place, np.nan).T, '.-', ms=2, lw=2, color=colour)
        keys.append(Line2D([], [], color=colour, lw=3, label=word))
    both = np.concatenate([points, place])
    extent = float(np.ptp(both, axis=0).max()) + 0.1
    rows = moments(len(place))
    shapes = robot_drawing.visible([shape] * len(rows) if shape else None, extent)
    style.frame(axes, both, robot_drawing.room(shapes, extent))
    robot_drawing.draw_way(axes, [run.poses[row] for row in rows], shapes, style.ink())
    robot_drawing.name_ends(axes, place[[0, -1]], shapes, extent, list(both))
    axes.set_title(
        f'route (grey), {robot_drawing.caption(shapes)}', fontsize=style.SMALL, fontweight='normal'
    )
    axes.figure.legend(handles=keys, loc='outside lower left', ncols=3)


def _held(run: Prediction) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """Yield each that holds the speed down, and at which steps."""
    held = np.array(run.held_by())
    for holder in HOLDERS:
        here = held == holder
        if here.any():
            yield holder, here


def _draw_time(axes: dict[str, Any], run: Prediction) -> None:
    """Draw the speed over what holds it down, and how fast the robot turns."""
    time = run.dt * np.arange(len(run.steps))
    driven = np.array([np.hypot(*step.twist[:2]) for step in run.steps])
    for holder, here in _held(run):
        filled = here.copy()
        filled[1:] |= here[:-1]  # up to where the next begins
        axes['speed'].fill_between(
            time, driven, where=filled, color=HOLDERS[holder][1], alpha=0.5, lw=0
        )
    axes['speed'].plot(time, driven, color=style.ink(), lw=1.2)
    axes['speed'].set(ylabel='[m/s]', ylim=(0.0, None), title='Speed, and what holds it down')
    axes['speed'].tick_params(labelbottom=False)
    turn = np.array([step.twist.wz for step in run.steps])
    axes['turn'].plot(time, turn, color=style.ink(), lw=1.2)
    style.scale(axes['turn'], turn, least=0.1)
    axes['turn'].set(ylabel='[rad/s]', title='Turn rate, to the left positive')
    end = float(time[-1]) if len(time) else 1.0
    for each in ('speed', 'turn'):
        style.time_axis(axes[each], end)
    axes['speed'].set_xlabel('')
