"""Transforms between frames, and those of joints: three axes, unit quaternions.

A transform tells where the frame `child` is, seen from its `parent`. The first frame of a robot
moves in the plane; its turrets and wheels turn about axes of their own.
"""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from agv_motion.planar import Pose

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w; of unit length"""

NO_ROTATION: Quaternion = (0.0, 0.0, 0.0, 1.0)


class Transform(NamedTuple):
    """Where a frame is at an instant, seen from another."""

    stamp: int
    """[ns]"""
    parent: str
    child: str
    translation: Vector
    """[m]"""
    rotation: Quaternion


def planar(stamp: int, parent: str, child: str, pose: Pose) -> Transform:
    """Return a transform in the plane: ``pose`` of the child, seen from the parent."""
    half = 0.5 * pose.theta
    rotation = 0.0, 0.0, sin(half), cos(half)
    return Transform(stamp, parent, child, (pose.x, pose.y, 0.0), rotation)


def turn(axis: Vector, angle: float) -> Quaternion:
    """Return the rotation by ``angle`` [rad], of any number of turns, about a unit vector."""
    s = sin(0.5 * angle)
    return s * axis[0], s * axis[1], s * axis[2], cos(0.5 * angle)


def roll_pitch_yaw(angles: Vector) -> Quaternion:
    """Return the rotation about the fixed axes x, then y, then z by ``angles`` [rad], as URDF."""
    roll, pitch, yaw = angles
    about_x, about_y = turn((1.0, 0.0, 0.0), roll), turn((0.0, 1.0, 0.0), pitch)
    return product(turn((0.0, 0.0, 1.0), yaw), product(about_y, about_x))


def product(first: Quaternion, second: Quaternion) -> Quaternion:
    """Return the rotation ``second`` as seen from a frame that ``first`` has turned."""
    ax, ay, az, aw = first
    bx, by, bz, bw = second
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotated(rotation: Quaternion, vector: Vector) -> Vector:
    """Return ``vector`` turned by ``rotation``."""
    x, y, z, w = rotation
    vx, vy, vz = vector
    tx, ty, tz = 2.0 * (y * vz - z * vy), 2.0 * (z * vx - x * vz), 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )
