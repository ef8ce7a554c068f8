"""The figure of `agv route`: the way driven on the route, and what holds the speed down."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report.figure import figure
from agv_motion.route.prediction import NOTHING
from agv_motion.route.speeds import RouteLimiter

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.route.prediction import Prediction
    from agv_motion.route.route import Route

COLOURS = dict(
    zip(
        (NOTHING, *(limiter.value for limiter in RouteLimiter)),
        ('0.4', 'tab:red', 'tab:orange', 'tab:purple', 'tab:green', 'tab:blue'),
        strict=True,
    )
)
"""Of each that holds the speed down."""


def draw(route: Route, run: Prediction, path: Path) -> None:
    """Draw ``run`` on ``route`` into a picture.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    with figure(
        path, [['map', 'speed'], ['map', 'turn']], figsize=(13, 6.5), width_ratios=[1.1, 1]
    ) as axes:
        _draw_map(axes['map'], route, run)
        _draw_time(axes, run)


def _draw_map(axes: Any, route: Route, run: Prediction) -> None:
    axes.plot(*np.array(route.waypoints).T, 'o-', color='0.8', lw=5, ms=7, label='route')
    place = np.array([pose[:2] for pose in run.poses])
    for holder, here in _held(run):
        way = np.where(here[:, None], place, np.nan)
        axes.plot(*way.T, '.-', ms=3, lw=1.5, color=COLOURS[holder], label=f'held by {holder}')
    axes.plot(*place[0], 's', color='k', label='start')
    axes.plot(*place[-1], '*', ms=12, color='k', label='end')
    axes.set(
        aspect='equal', xlabel='x [m]', ylabel='y [m]', adjustable='datalim',
        title='the way of an ideal robot, and what holds its speed down',
    )  # fmt: skip
    axes.legend(fontsize='small')


def _held(run: Prediction) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """Yield each that holds the speed down, and at which steps."""
    held = np.array(run.held_by())
    for holder in COLOURS:
        here = held == holder
        if here.any():
            yield holder, here


def _draw_time(axes: dict[str, Any], run: Prediction) -> None:
    time = run.dt * np.arange(len(run.steps))
    driven = np.array([np.hypot(*step.twist[:2]) for step in run.steps])
    wanted = np.array([step.limits.speed for step in run.steps])
    for holder, here in _held(run):
        axes['speed'].fill_between(
            time, driven, where=here, color=COLOURS[holder], alpha=0.4, lw=0, step='mid'
        )
    axes['speed'].plot(time, wanted, 'k:', lw=1, label='V, before the coupling')
    axes['speed'].plot(time, driven, 'k', lw=1, label='commanded')
    axes['speed'].set(ylabel='speed [m/s]', ylim=(0.0, None))
    axes['speed'].legend(fontsize='small')
    axes['turn'].plot(
        time, [step.limits.heading_error for step in run.steps], color='0.5', label='dphi [rad]'
    )
    axes['turn'].plot(time, [step.twist.wz for step in run.steps], 'k', lw=1, label='omega [rad/s]')
    axes['turn'].set(xlabel='time [s]')
    axes['turn'].legend(fontsize='small')
