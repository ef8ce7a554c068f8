"""A sequence before it runs: the way of an ideal robot, and how long each action takes."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.route.prediction import predict as predict_route
from agv_motion.sequence.actions import FollowRoute, Wait
from agv_motion.trajectory.ghost import Ghost

if TYPE_CHECKING:
    from agv_motion.planar import Pose
    from agv_motion.route.parameters import FollowParameters
    from agv_motion.sequence.sequence import Sequence, SequenceStep
    from agv_motion.trajectory.ghost_parameters import GhostParameters


class Predicted(NamedTuple):
    """One action of an ideal robot."""

    step: SequenceStep
    begin: float
    """[s] after the start of the sequence"""
    duration: float
    """[s]"""
    poses: list[Pose]
    """one every ``dt``, and the end"""

    @property
    def end(self) -> Pose:
        """Where it ends."""
        return self.poses[-1]

    @property
    def length(self) -> float:
        """Way driven [m], between the poses."""
        return sum(
            hypot(b.x - a.x, b.y - a.y) for a, b in zip(self.poses, self.poses[1:], strict=False)
        )

    @property
    def warning(self) -> str:
        """Why the action will fail; empty if it will not."""
        step = self.step
        if self.duration <= step.timeout:
            return ''
        return (
            f'{step.where}: {step.name}: takes {self.duration:.1f} s, but its timeout is '
            f'{step.timeout:g} s'
        )


def predict(
    sequence: Sequence,
    start: Pose,
    ghost: GhostParameters,
    follow: FollowParameters,
    dt: float = 0.05,
) -> list[Predicted]:
    """Return what an ideal robot does, action by action.

    Args:
        sequence: What to do.
        start: Where it stands.
        ghost: Limits of the robot.
        follow: How it follows a route.
        dt: Between two poses [s].

    Raises:
        ConfigurationError: An action cannot be planned; the message says where it stands.

    """
    found: list[Predicted] = []
    begin, pose = 0.0, start
    for step in sequence.steps:
        try:
            duration, poses = _perform(step, pose, ghost, follow, dt)
        except AgvMotionError as error:
            msg = f'{step.where}: {step.name}: {error}'
            raise ConfigurationError(msg) from error
        found.append(Predicted(step, begin, duration, poses))
        begin, pose = begin + duration, poses[-1]
    return found


def _perform(
    step: SequenceStep, pose: Pose, ghost: GhostParameters, follow: FollowParameters, dt: float
) -> tuple[float, list[Pose]]:
    """Return duration [s] and poses of one action."""
    action = step.action
    if isinstance(action, Wait):
        return action.seconds, [pose]
    if isinstance(action, FollowRoute):
        run = predict_route(action.route, follow, pose, dt, step.timeout + dt, limits=ghost)
        return run.duration, run.poses
    trajectory = action.plan(Ghost(pose, ghost))
    return trajectory.duration, trajectory.polyline(dt)
