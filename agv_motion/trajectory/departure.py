"""How a moving Ghost leaves its trajectory for another: with as little braking as that needs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import GeometryError
from agv_motion.trajectory.braking import Braking
from agv_motion.trajectory.motion import STILL

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from agv_motion.planar import Pose
    from agv_motion.trajectory.motion import Speeds
    from agv_motion.trajectory.trajectory import Trajectory

DEPARTURES = (0.0, 0.25, 0.5, 0.75, 0.9)
"""Shares of the way to a stop, in time, at which a new trajectory may leave the old one. By
quarters, for each try is a plan of its own; the last one for curves that allow hardly any speed."""

AT_ONCE = DEPARTURES[:1]
"""For plans of which each try takes its time: now, or from rest."""


def leave(
    trajectory: Trajectory,
    time: float,
    rate: float,
    plan: Callable[[Pose, Speeds], Trajectory],
    departures: Sequence[float] = DEPARTURES,
) -> Trajectory:
    """Return what ``plan`` makes, after as little braking on ``trajectory`` as it needs.

    Args:
        trajectory: What is followed now, in motion.
        time: How long it has been followed [s].
        rate: Share of time that passes for it.
        plan: Plans from a pose and the speeds there.
        departures: Shares of the way to a stop at which to try.

    Raises:
        AgvMotionError: What ``plan`` raises from rest.

    """
    stopped = trajectory.stopped(time)
    left = (stopped.duration - time) / rate
    for share in departures:
        braking = Braking(stopped, time, rate, share * left)
        try:
            return plan(braking.end, braking.end_speeds).after(braking)
        except GeometryError:
            continue
    braking = Braking(stopped, time, rate, left)
    return plan(stopped.end, STILL).after(braking)
