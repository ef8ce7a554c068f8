"""What `agv drive` sends a robot to do, as a dry run and as the graph do it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.nodes.ghost_trajectory import GhostTrajectoryParameters
    from agv_motion.planar import Pose
    from agv_motion.trajectory.ghost import Ghost
    from agv_motion.trajectory.trajectory import Trajectory


class DriveGoal(NamedTuple):
    """What the node is to do, as a dry run and as the graph do it."""

    plan: Callable[[Ghost, GhostTrajectoryParameters], Trajectory]
    poses: list[Pose]
    arc: tuple[float, float] | None
    """Angle [rad] and inner diameter [m]"""
    changes: dict[str, float | bool]
    """Of the parameters of the node, for this goal alone"""
