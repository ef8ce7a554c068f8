"""The polar command of the tree, dimensionless, and its mapping to a twist in SI units."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.planar import Twist, require_finite, wrap

if TYPE_CHECKING:
    from agv_motion.planar import Pose

LINEAR_SPEED = 1.0 / 60.0
"""[m/s] trunk speed at v = 1, and of the rim at omega = 1: one metre a minute."""


class PolarCommand(NamedTuple):
    """Motion without a preferred direction."""

    v: float
    """[-] in [0, 1], share of the trunk's top speed"""
    theta: float
    """[rad] in [-pi, pi), direction of motion in the base frame"""
    omega: float
    """[-] in [-1, 1], rotation, counter-clockwise positive"""


STILL = PolarCommand(0.0, 0.0, 0.0)


def checked(command: PolarCommand) -> PolarCommand:
    """Return ``command`` if it lies in its domain.

    Raises:
        SignalError: A number is not finite, or outside its domain.

    """
    require_finite('polar command (v, theta, omega)', command)
    if not 0.0 <= command.v <= 1.0:
        msg = f'v = {command.v}: must lie in [0, 1]; go backwards by turning theta by pi'
        raise SignalError(msg)
    if not -pi <= command.theta < pi:
        msg = f'theta = {command.theta}: must lie in [-pi, pi); wrap it'
        raise SignalError(msg)
    if not -1.0 <= command.omega <= 1.0:
        msg = f'omega = {command.omega}: must lie in [-1, 1]'
        raise SignalError(msg)
    return command


def polar_command(
    pose: Pose, target: tuple[float, float], speed: float, rotation: float
) -> PolarCommand:
    """Return the command towards ``target``.

    Args:
        pose: Of the platform in the map.
        target: Where to head for, in the map [m].
        speed: v, in [0, 1].
        rotation: omega, in [-1, 1].

    """
    bearing = atan2(target[1] - pose.y, target[0] - pose.x)
    return PolarCommand(speed, wrap(bearing - pose.theta), rotation)


def to_twist(
    command: PolarCommand,
    linear_speed: float = LINEAR_SPEED,
    platform_radius: float = PLATFORM_RADIUS,
) -> Twist:
    """Return the twist of a polar command: ``(v cos(theta) V, v sin(theta) V, omega V / R)``.

    Args:
        command: The dimensionless command.
        linear_speed: V, the trunk's speed at v = 1 [m/s].
        platform_radius: R [m].

    Raises:
        SignalError: A number is not finite.

    """
    require_finite('polar command (v, theta, omega)', command)
    speed = command.v * linear_speed
    return Twist(
        speed * cos(command.theta),
        speed * sin(command.theta),
        command.omega * linear_speed / platform_radius,
    )


def to_polar(
    twist: Twist,
    linear_speed: float = LINEAR_SPEED,
    platform_radius: float = PLATFORM_RADIUS,
) -> PolarCommand:
    """Return the polar command of a twist, the inverse of :func:`to_twist`.

    Args:
        twist: In the frame of the platform.
        linear_speed: V, at v = 1 [m/s].
        platform_radius: R [m].

    Raises:
        SignalError: A number is not finite.

    """
    require_finite('twist (vx, vy, wz)', twist)
    return PolarCommand(
        hypot(twist.vx, twist.vy) / linear_speed,
        wrap(atan2(twist.vy, twist.vx)),
        twist.wz * platform_radius / linear_speed,
    )
