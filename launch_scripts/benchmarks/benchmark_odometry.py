"""Odometry and fusion beside WPILib's, which is C++ behind Python bindings: floats to floats."""

from __future__ import annotations

from itertools import count
from math import cos, pi, sin

from measure import Row, per_call
from wpimath.estimator import SwerveDrive3PoseEstimator
from wpimath.geometry import Pose2d, Rotation2d, Translation2d
from wpimath.kinematics import SwerveDrive3Kinematics, SwerveDrive3Odometry, SwerveModulePosition

from agv_motion.kinematics.omniwheel_placement import wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.base import Base, OmniBase, TurretBase
from agv_motion.odometry.covariance import CERTAIN, Covariance
from agv_motion.odometry.fix import Fix
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.planar import Pose

PLACES = [(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)]
PERIOD = 0.02
SEEN = Covariance(0.0225, 0.0, 0.0, 0.0225, 0.0, 0.01)


def own_update(base: Base, steering: tuple[float, ...] = ()) -> float:
    """Return the time of one reading of three encoders: pose and covariance [s]."""
    odometry, steps = WheelOdometry(base, [0.05] * 3), count()

    def update() -> Pose:
        i = next(steps)
        odometry.update(PERIOD * i, [0.10 * i, 0.11 * i, 0.12 * i], steering)
        return odometry.pose

    return per_call(update)


def modules(i: int) -> tuple[SwerveModulePosition, ...]:
    """Return the travels of WPILib's three modules after step ``i``."""
    return tuple(SwerveModulePosition(0.005 * i, Rotation2d(0.1)) for _ in range(3))


def peer_update() -> float:
    """Return the time of WPILib's step, which takes the turn from a gyroscope [s]."""
    kinematics = SwerveDrive3Kinematics(*(Translation2d(*place) for place in PLACES))
    odometry, steps = SwerveDrive3Odometry(kinematics, Rotation2d(0.0), modules(0)), count()

    def update() -> tuple[float, float, float]:
        pose = odometry.update(Rotation2d(0.1), modules(next(steps)))
        return pose.x, pose.y, pose.rotation().radians()

    return per_call(update)


def own_fix(late: int) -> float:
    """Return the time of a fix that is ``late`` steps old, among 50 steps a second [s]."""
    fusion, steps = PoseFusion(), count(1)
    fusion.add_odometry(0.0, Pose(0.0, 0.0, 0.0), CERTAIN)
    fusion.set_pose(Pose(0.0, 0.0, 0.0), SEEN)
    times = []
    for i in steps:
        fusion.add_odometry(PERIOD * i, Pose(0.005 * i, 0.0, 0.0), CERTAIN)
        if i % 50 == 0:
            fix = Fix(PERIOD * (i - late), 0.005 * (i - late), 0.0, SEEN, 0.0)
            times.append(per_call(lambda fix=fix: (fusion.add_fix(fix), fusion.estimate()), 1, 1))
        if len(times) == 500:
            return sorted(times)[250]
    raise AssertionError


def peer_fix(late: int) -> float:
    """Return the time of WPILib's vision measurement of the same age [s]."""
    kinematics = SwerveDrive3Kinematics(*(Translation2d(*place) for place in PLACES))
    estimator = SwerveDrive3PoseEstimator(kinematics, Rotation2d(0.0), modules(0), Pose2d())
    times = []
    for i in count(1):
        estimator.updateWithTime(PERIOD * i, Rotation2d(0.1), modules(i))
        if i % 50 == 0:
            seen = Pose2d(0.005 * (i - late), 0.0, Rotation2d(0.0)), PERIOD * (i - late)

            def fix(seen: tuple[Pose2d, float] = seen) -> tuple[float, float]:
                estimator.addVisionMeasurement(*seen)
                pose = estimator.getEstimatedPosition()
                return pose.x, pose.y

            times.append(per_call(fix, 1, 1))
        if len(times) == 500:
            return sorted(times)[250]
    raise AssertionError


def rows() -> list[Row]:
    """Measure ours and theirs in turn."""
    omni = OmniBase(OmniWheels(wheels_on_circle([pi / 6, 5 * pi / 6, 3 * pi / 2], [0.2] * 3)))
    turrets = TurretBase(Turrets(PLACES))
    peer = 'robotpy-wpimath'
    return [
        Row('odometry, 3 omni wheels', own_update(omni), peer, peer_update(), '3 us'),
        Row('odometry, 3 turrets', own_update(turrets, (0.1,) * 3), peer, peer_update()),
        Row('position fix in time, and the pose', own_fix(0), peer, peer_fix(0), '60 us'),
        Row('position fix 0.9 s late, and the pose', own_fix(45), peer, peer_fix(45), '60 us'),
    ]


if __name__ == '__main__':
    for row in rows():
        print(f'{row.what}: {row.ours * 1e6:.2f} us; {row.peer}: {row.theirs * 1e6:.2f} us')
