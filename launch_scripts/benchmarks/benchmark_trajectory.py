"""The Ghost beside WPILib's trajectory generator: the same curve, the same limits, C++ there.

WPILib's handles are 1.2 times the distance over 3, so its curve is ours with delta_curve = 0.4.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from measure import Row, per_call
from wpimath.geometry import Pose2d, Rotation2d, Translation2d
from wpimath.kinematics import DifferentialDriveKinematics
from wpimath.trajectory import Trajectory, TrajectoryConfig, TrajectoryGenerator
from wpimath.trajectory.constraint import (
    CentripetalAccelerationConstraint,
    DifferentialDriveKinematicsConstraint,
)

from agv_motion.planar import Pose
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.planner import Planner
from agv_motion.trajectory.request import Request

if TYPE_CHECKING:
    from collections.abc import Sequence

TRACK, WHEEL_SPEED, LATERAL, RAMPS, CRUISE = 0.3, 0.8, 0.3, 0.5, 0.7
LIMITS = GhostParameters(
    track=TRACK, wheel_speed=WHEEL_SPEED, lateral_acceleration=LATERAL, turn_rate=100.0
)
START = Pose(0.0, 0.0, 0.0)
SEGMENTS = {
    '3 m, S of 60 degrees': Pose(2.8, 1.08, pi / 3),
    '3 m, straight': Pose(3.0, 0.0, 0.0),
    '3 m, U-turn': Pose(0.0, 3.0, -pi),
}
WAYPOINTS = [Pose(2.0, 0.5, 0.5), Pose(3.0, 2.0, 1.5), Pose(2.0, 3.5, 2.5), Pose(0.0, 4.0, 3.0)]


def own_plan(goals: Sequence[Pose]) -> float:
    """Return the duration of our trajectory [s]."""
    request = Request(RAMPS, CRUISE, 0.4)
    return Planner(LIMITS).drive(START, goals, request).duration


def peer_plan(goals: Sequence[Pose]) -> Trajectory:
    """Return WPILib's trajectory under the same limits; inner headings are its own choice."""
    config = TrajectoryConfig(CRUISE, RAMPS)
    config.addConstraint(CentripetalAccelerationConstraint(LATERAL))
    kinematics = DifferentialDriveKinematics(TRACK)
    config.addConstraint(DifferentialDriveKinematicsConstraint(kinematics, WHEEL_SPEED))
    poses = [Pose2d(x, y, Rotation2d(theta)) for x, y, theta in (START, goals[-1])]
    inner = [Translation2d(x, y) for x, y, _ in goals[:-1]]
    return TrajectoryGenerator.generateTrajectory(poses[0], inner, poses[1], config)


def own_cycle() -> float:
    """Return the time of one advance and what the servo asks for [s]."""
    ghost = Ghost(START, LIMITS)
    ghost.compute_trajectory(SEGMENTS['3 m, S of 60 degrees'], 0.4, RAMPS, CRUISE)
    ghost.lock(False)  # noqa: FBT003

    def cycle() -> None:
        ghost.advance(1e-4)
        ghost.controller_kinetics(0.02)

    return per_call(cycle)


def peer_cycle() -> float:
    """Return the time of one sample of WPILib's trajectory, as floats [s]."""
    trajectory = peer_plan([SEGMENTS['3 m, S of 60 degrees']])
    time = 0.0

    def cycle() -> tuple[float, ...]:
        nonlocal time
        time += 1e-4
        state = trajectory.sample(time)
        pose = state.pose
        return pose.x, pose.y, pose.rotation().radians(), state.velocity, state.curvature

    return per_call(cycle)


def rows() -> list[Row]:
    """Measure ours and theirs in turn; the durations on the road are times too."""
    peer = 'robotpy-wpimath'
    found = [Row('Ghost: advance and kinetics', own_cycle(), peer, peer_cycle(), '10 us')]
    for what, goals in [(name, [goal]) for name, goal in SEGMENTS.items()] + [
        ('five waypoints', WAYPOINTS)
    ]:
        ours = per_call(lambda goals=goals: own_plan(goals), calls=50)
        theirs = per_call(lambda goals=goals: peer_plan(goals), calls=50)
        found.append(Row(f'plan, {what}', ours, peer, theirs, '0.5 ms'))
    for name, goal in SEGMENTS.items():
        theirs = peer_plan([goal]).totalTime()
        found.append(Row(f'on the road, {name}', own_plan([goal]), peer, theirs, 'ratio 1.00'))
    return found


if __name__ == '__main__':
    for row in rows():
        ratio = row.ours / row.theirs
        print(f'{row.what}: {row.ours:.7f} s; {row.peer}: {row.theirs:.7f} s; {ratio:.5f}')
