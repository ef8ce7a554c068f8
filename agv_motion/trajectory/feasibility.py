"""The report of a trajectory before anything moves: what it asks, where and why it is slow."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.trajectory.motions import DriveMotion, TurnMotion

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.trajectory.trajectory import Trajectory

STRAIGHT = 1e-3
"""[1/m] A bend of less is not worth a word."""

MOST_LINES = 10
"""Of a report; of many slow stretches it tells the slowest."""


class Slow(NamedTuple):
    """A stretch on which the curve does not allow the cruising speed."""

    start: float
    """[m] of way driven"""
    end: float
    """[m]"""
    speed: float
    """[m/s] the lowest allowed there"""
    reason: str
    """name of the limit"""


class Feasibility(NamedTuple):
    """What a trajectory asks of the robot."""

    length: float
    """[m] of way driven"""
    turn: float
    """[rad] turned on the spot, all turns added up without sign"""
    duration: float
    """[s]"""
    top_speed: float
    """[m/s] reached on the way"""
    top_curvature: float
    """[1/m] of the sharpest bend"""
    slow: tuple[Slow, ...]
    """where and why the cruising speed is not allowed, in the order of the way"""

    def lines(self) -> list[str]:
        """Return it in words, one thing a line; `MOST_LINES` at most."""
        lines = [f'{self.length:.2f} m in {self.duration:.1f} s, at most {self.top_speed:.2f} m/s']
        if self.turn > 0.0:
            lines.append(f'turns on the spot: {degrees(self.turn):.0f} degrees in all')
        if self.top_curvature > STRAIGHT:
            lines.append(f'sharpest bend: radius {1.0 / self.top_curvature:.2f} m')
        room = MOST_LINES - len(lines)
        told = self.slow
        if len(told) > room:
            slowest = sorted(told, key=lambda stretch: stretch.speed)[: room - 1]
            told = tuple(stretch for stretch in told if stretch in slowest)[: room - 1]
        lines += (
            f'from {start:.2f} m to {end:.2f} m no faster than {speed:.2g} m/s: {reason}'
            for start, end, speed, reason in told
        )
        if len(told) < len(self.slow):
            lines.append(f'and {len(self.slow) - len(told)} more stretches, less slow')
        return lines


def examine(trajectory: Trajectory) -> Feasibility:
    """Return what ``trajectory`` asks of the robot, and where it has to be slow."""
    drives = [motion for motion in trajectory.motions if isinstance(motion, DriveMotion)]
    slow: list[Slow] = []
    driven = 0.0
    for motion in trajectory.motions:
        if isinstance(motion, DriveMotion):
            slow += _stretches(trajectory, motion, driven)
        driven += motion.length
    return Feasibility(
        length=driven,
        turn=sum(motion.angle for motion in trajectory.motions if isinstance(motion, TurnMotion)),
        duration=trajectory.duration,
        top_speed=max((drive.profile.top_speed for drive in drives), default=0.0),
        top_curvature=max((_top_curvature(drive) for drive in drives), default=0.0),
        slow=tuple(slow),
    )


def _top_curvature(drive: DriveMotion) -> float:
    course = drive.course
    return float(max(np.abs(course.curvature).max(), np.abs(course.middle_curvature).max()))


def _stretches(trajectory: Trajectory, drive: DriveMotion, driven: float) -> Iterator[Slow]:
    """Yield the runs of nodes that are held below the cruising speed by one limit."""
    course, limits, request = drive.course, trajectory.limits, trajectory.request
    if not limits or request is None:
        return
    ceilings = np.stack([limit.ceiling(course.curvature) for limit in limits])
    joints = np.flatnonzero(course.way[1:] <= course.way[:-1])  # their nodes stand twice
    steps = course.curvature[joints + 1] - course.curvature[joints]
    for ceiling, limit in zip(ceilings, limits, strict=True):
        for side in (joints, joints + 1):
            ceiling[side] = np.minimum(ceiling[side], limit.at_joints(steps))
    lowest = ceilings.min(axis=0)
    slow = lowest < request.cruising_speed * (1.0 - 1e-9)
    holder = np.where(slow, ceilings.argmin(axis=0), -1)
    for nodes in np.split(np.arange(len(holder)), np.flatnonzero(np.diff(holder)) + 1):
        if slow[nodes[0]]:
            yield Slow(
                start=driven + float(course.way[nodes[0]]),
                end=driven + float(course.way[nodes[-1]]),
                speed=float(lowest[nodes].min()),
                reason=limits[holder[nodes[0]]].name,
            )
