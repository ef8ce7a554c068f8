"""Poses and twists in the plane: the group SE(2), its exponential and its logarithm.

Frames follow REP-103: x forward, y left, angles counter-clockwise; metres, radians, seconds.
Source: E. Eade, "Lie Groups for 2D and 3D Transformations", 2017, section 3 (SE(2)).
"""

from __future__ import annotations

from math import cos, isfinite, pi, sin, tau
from typing import NamedTuple

from agv_motion.errors import SignalError

SMALL_ANGLE = 1e-4
"""[rad] Below this the series of sin(a)/a and (1 - cos a)/a are exact to double precision."""

STANDSTILL = 1e-9
"""[m/s] A speed below this is none: rounding, which has no direction of its own."""

THERE = 1.0 - 1e-12
"""[-] Share of the way to a target that is all of it."""

FARTHEST = 1e7
"""[m] of any place from the origin of its map, along each axis: as far as UTM goes."""

FASTEST = 1000.0
"""[m/s], [rad/s] No robot is meant that would be faster: the number is a mistake."""


class Pose(NamedTuple):
    """Where a frame is, seen from another."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    theta: float
    """[rad] heading, in [-pi, pi)"""


class Twist(NamedTuple):
    """Velocity of a rigid body in its own frame; times a duration, a displacement."""

    vx: float
    """[m/s] forward"""
    vy: float
    """[m/s] to the left"""
    wz: float
    """[rad/s] counter-clockwise"""


REST = Twist(0.0, 0.0, 0.0)


def without_minus_zero(twist: Twist) -> Twist:
    """Return the same twist, no zero in it with a minus before it."""
    return Twist(twist[0] + 0.0, twist[1] + 0.0, twist[2] + 0.0)


def wrap(angle: float) -> float:
    """Return ``angle`` [rad] brought into [-pi, pi); one that lies there is left as it is."""
    if -pi <= angle < pi:
        return angle
    wrapped = (angle + pi) % tau - pi
    return wrapped if wrapped < pi else -pi  # the modulo of a tiny negative rounds up to tau


def require_finite(name: str, values: tuple[float, ...]) -> None:
    """Raise unless every number of ``values`` is finite.

    Raises:
        SignalError: One of them is NaN or infinite; the message names it.

    """
    if not isfinite(sum(values)) and not all(map(isfinite, values)):
        msg = f'{name} must be finite, got {tuple(values)}: discard it and keep the last good one'
        raise SignalError(msg)


def require_twist(twist: Twist) -> None:
    """Raise unless ``twist`` is one that somebody can mean.

    Raises:
        SignalError: A number is not finite, or beyond any robot.

    """
    vx, vy, wz = twist
    if not (abs(vx) <= FASTEST and abs(vy) <= FASTEST and abs(wz) <= FASTEST):
        require_finite('twist (vx, vy, wz)', twist)
        msg = f'twist {tuple(twist)}: at most {FASTEST:g} m/s and rad/s; look at the units'
        raise SignalError(msg)


def compose(first: Pose, second: Pose) -> Pose:
    """Return the pose reached by ``second`` as seen from ``first``."""
    (x, y, theta), (dx, dy, turn) = first, second
    c, s = cos(theta), sin(theta)
    return Pose(x + c * dx - s * dy, y + s * dx + c * dy, wrap(theta + turn))


def inverse(pose: Pose) -> Pose:
    """Return the pose of the parent frame seen from ``pose``."""
    c, s = cos(pose.theta), sin(pose.theta)
    return Pose(-c * pose.x - s * pose.y, s * pose.x - c * pose.y, wrap(-pose.theta))


def exponential(twist: Twist, duration: float = 1.0) -> Pose:
    r"""Return the pose after following a constant ``twist`` for ``duration`` [s] from the origin.

    With :math:`a = \omega t`, the displacement is :math:`V(a) (v_x, v_y)\,t` where

    .. math:: V(a) = \frac{1}{a}\begin{pmatrix}\sin a & \cos a - 1\\ 1 - \cos a & \sin a
        \end{pmatrix}

    so an arc is followed exactly, whatever its length.
    """
    dx, dy, angle = twist.vx * duration, twist.vy * duration, twist.wz * duration
    if abs(angle) < SMALL_ANGLE:
        along, across = 1.0 - angle * angle / 6.0, angle / 2.0
    else:
        along, across = sin(angle) / angle, (1.0 - cos(angle)) / angle
    return Pose(along * dx - across * dy, across * dx + along * dy, wrap(angle))


def logarithm(pose: Pose) -> Twist:
    """Return the constant twist that leads from the origin to ``pose`` in one second.

    The inverse of :func:`exponential` for turns shorter than half a turn.
    """
    half = pose.theta / 2.0
    along = 1.0 - half * half / 3.0 if abs(half) < SMALL_ANGLE else half * cos(half) / sin(half)
    return Twist(along * pose.x + half * pose.y, along * pose.y - half * pose.x, pose.theta)


def integrate(pose: Pose, twist: Twist, duration: float) -> Pose:
    """Return ``pose`` after moving with a constant ``twist`` for ``duration`` [s], exactly."""
    return compose(pose, exponential(twist, duration))
