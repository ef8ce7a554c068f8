"""WPILib's command of three turrets, which the benchmarks put beside ours."""

from __future__ import annotations

from math import cos, pi, sin

from wpimath.geometry import Translation2d
from wpimath.kinematics import ChassisSpeeds, SwerveDrive3Kinematics

POSITIONS = [(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)]
LIMIT = 2.0 / 60.0
"""[m/s] of the wheels"""
TWIST = (0.01, 0.004, 0.012)
_PEER = SwerveDrive3Kinematics(*(Translation2d(x, y) for x, y in POSITIONS))


def wpilib_command() -> list[tuple[float, float]]:
    """Return angle [rad] and speed [m/s] of each turret: kinematics and scaling, floats out."""
    states = _PEER.toSwerveModuleStates(ChassisSpeeds(*TWIST))
    states = _PEER.desaturateWheelSpeeds(states, LIMIT)
    return [(state.angle.radians(), state.speed) for state in states]
