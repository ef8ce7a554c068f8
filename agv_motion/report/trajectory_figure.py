"""The figure of a planned trajectory: its way, its speeds, and which limit holds it down."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.report import robot_drawing, style
from agv_motion.report.figure import figure
from agv_motion.report.recorded_footprint import moments
from agv_motion.trajectory.feasibility import examine

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.model.footprint import Footprint
    from agv_motion.trajectory.ghost_parameters import GhostParameters
    from agv_motion.trajectory.trajectory import Trajectory

SAMPLES = 1000

NEAR = 0.02
"""[m] How far around a place where it is slow the way is marked, to be seen."""

COLOURS = {
    'lateral acceleration': style.GOAL,
    'wheel speed': style.HINDERED,
    'turn rate': style.OTHERS[0],
    'jump of curvature': style.OTHERS[2],
}


def draw(
    trajectory: Trajectory, limits: GhostParameters, path: Path, shape: Footprint | None = None
) -> None:
    """Draw ``trajectory`` of a robot with ``limits`` into a picture.

    Args:
        trajectory: What is planned.
        limits: Of the robot.
        path: Of the picture.
        shape: What the robot covers of the floor; None: not known.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    time = np.linspace(0.0, trajectory.duration, SAMPLES)
    poses = np.array([trajectory.pose(t) for t in time.tolist()])
    speeds = np.array([trajectory.speeds(t) for t in time.tolist()])
    driven = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(poses[:, :2], axis=0).T))))
    mosaic = [['map', 'speed'], ['map', 'turn']]
    with figure(path, mosaic, figsize=(style.WIDTH, 5.4), width_ratios=[1, 1]) as axes:
        held_by = ', '.join(sorted({slow.reason for slow in examine(trajectory).slow}))
        style.title(
            axes['map'],
            f'{driven[-1]:.1f} m in {trajectory.duration:.1f} s, '
            + (f'slowed by {held_by}' if held_by else 'nowhere slowed by a limit'),
        )
        held = {slow.reason: np.zeros(SAMPLES, dtype=bool) for slow in examine(trajectory).slow}
        for slow in examine(trajectory).slow:
            held[slow.reason] |= (driven >= slow.start - NEAR) & (driven <= slow.end + NEAR)
        _draw_map(axes['map'], poses, held, shape)
        _draw_speeds(axes['speed'], time, speeds, limits, held)
        axes['turn'].plot(time, speeds[:, 1], color=style.ink(), lw=1.2)
        axes['turn'].set(ylabel='[rad/s]', title='Turn rate, to the left positive')
        for each in ('speed', 'turn'):
            style.time_axis(axes[each], trajectory.duration)
            axes[each].grid()
        axes['speed'].set_xlabel('')
        axes['speed'].tick_params(labelbottom=False)


def _draw_map(axes: Any, poses: Any, held: dict[str, Any], shape: Footprint | None) -> None:
    """Draw the way with its direction, where which limit slows it, and the robot at both ends."""
    axes.plot(*poses[:, :2].T, color=style.PATH, lw=2)
    style.direction(axes, poses[:, :2], style.PATH, 5)
    for reason, here in held.items():
        way = np.where(here[:, None], poses[:, :2], np.nan)
        axes.plot(*way.T, lw=6, alpha=0.5, color=COLOURS[reason], label=f'slowed by {reason}')
    extent = float(np.ptp(poses[:, :2], axis=0).max()) + 0.1
    rows = moments(len(poses))
    shapes = robot_drawing.visible([shape] * len(rows) if shape else None, extent)
    style.frame(axes, poses[:, :2], robot_drawing.room(shapes, extent))
    robot_drawing.draw_way(axes, poses[rows], shapes)
    robot_drawing.name_ends(axes, poses[[0, -1], :2], shapes, extent, list(poses[::20, :2]))
    axes.set_title(robot_drawing.caption(shapes), fontsize=style.SMALL, fontweight='normal')
    if held:
        axes.figure.legend(loc='outside lower left', ncols=2)


def _draw_speeds(
    axes: Any, time: Any, speeds: Any, limits: GhostParameters, held: dict[str, Any]
) -> None:
    linear, across = speeds[:, 0], 0.5 * limits.track * speeds[:, 1]
    for values, colour, name in (
        (linear - across, style.OTHERS[0], 'left wheel'),
        (linear + across, style.WAITING, 'right wheel'),
        (linear, style.ROBOT, 'robot'),
    ):
        axes.plot(time, values, color=colour, lw=1.2)
        style.line_label(axes, float(values[-1]), name, colour)
    for reason, here in held.items():
        axes.fill_between(time, linear, where=here, color=COLOURS[reason], alpha=0.3, lw=0)
    axes.set(ylabel='[m/s]', title='Speed')
