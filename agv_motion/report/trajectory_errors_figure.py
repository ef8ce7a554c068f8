"""The figure of trajectories beside their reference: the map, and the errors over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.errors import ConfigurationError
from agv_motion.report import style
from agv_motion.report.figure import figure
from agv_motion.report.trajectory_errors import Relation, statistics

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.report.trajectory_errors import TrajectoryComparison

NAMES = {
    Relation.TRANSLATION: 'Error of place [m]',
    Relation.ROTATION: 'Error of rotation [°]',
    Relation.FULL: 'Error of the whole pose [-]',
}


def draw(
    judged: Sequence[tuple[str, TrajectoryComparison]], path: Path, *, theme: str = 'light'
) -> None:
    """Draw some trajectories, each with its name; each with its own reference, of the same kind.

    Raises:
        ConfigurationError: There are more than colours, matplotlib is not installed, or does not
            know the kind of picture.
        SourceError: The file cannot be written.

    """
    if not 0 < len(judged) <= len(style.LINES):
        msg = f'--plot of {len(judged)} trajectories: at most {len(style.LINES)} can be told apart'
        raise ConfigurationError(msg)
    relations = list(judged[0][1].errors)
    mosaic: list[Any] = [['map', relation.value] for relation in relations]
    with figure(
        path, mosaic, theme=theme, figsize=(style.WIDTH, 4.6), width_ratios=[1.1, 1]
    ) as axes:
        style.title(axes['map'], finding(judged))
        _draw_map(axes['map'], judged)
        for relation in relations:
            panel = axes[relation.value]
            for colour, (_, one) in zip(style.LINES, judged, strict=False):
                time = (one.driven.stamp[one.rows] - one.driven.stamp[0]) * 1e-9
                panel.plot(*style.thinned(time, one.errors[relation]), color=colour, lw=1.0)
            panel.set(title=NAMES[relation], ylim=(0.0, None))
            panel.grid()
            panel.tick_params(labelbottom=relation is relations[-1])
        axes[relations[-1].value].set_xlabel('time [s]')


def finding(judged: Sequence[tuple[str, TrajectoryComparison]]) -> str:
    """Return what was found, in one line: the root mean square, of several that of the best."""
    relation = next(iter(judged[0][1].errors))
    unit = f' {relation.unit}' if relation.unit else ''
    name, value = min(
        ((name, statistics(one.errors[relation]).rmse) for name, one in judged),
        key=lambda found: found[1],
    )
    said = f'{relation.value} errs {value:.3g}{unit} (root mean square)'
    return f'{name}: {said}' if len(judged) == 1 else f'Best of {len(judged)}: {name}, {said}'


def _draw_map(axes: Any, judged: Sequence[tuple[str, TrajectoryComparison]]) -> None:
    everywhere = [one.reference.position[:, :2] for _, one in judged]
    drawn: list[Any] = []
    for place in everywhere:
        if not any(np.array_equal(place, other) for other in drawn):
            label = '_' if drawn else 'reference'
            axes.plot(*place.T, color=style.ink(), ls=(0, (5, 3)), lw=1.0, label=label)
            drawn.append(place)
    for colour, (name, one) in zip(style.LINES, judged, strict=False):
        place = one.driven.position[:, :2]
        axes.plot(*place.T, color=colour, lw=1.2, label=name)
        everywhere.append(place)
    first = judged[0][1].reference.position[:, :2]
    style.direction(axes, first, style.ink(), 5)
    together = np.concatenate(everywhere)
    extent = float(np.ptp(together, axis=0).max())
    style.frame(axes, together, 0.08 * extent + 0.1)
    style.name_near(axes, first[0], 0.04 * extent, 'start', style.ink(), list(together[::20]))
    axes.figure.legend(loc='outside lower left', ncols=2)
