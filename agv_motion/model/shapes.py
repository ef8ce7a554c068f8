"""What is to be seen of a link: boxes, cylinders, balls."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from agv_motion.model.transform import Vector

Color = tuple[float, float, float, float]
"""red, green, blue and opacity, each in [0, 1]"""


class Box(NamedTuple):
    """A box about its centre."""

    size: Vector
    """along x, y and z [m]"""


class Cylinder(NamedTuple):
    """A cylinder about its centre; its axis is z."""

    radius: float
    """[m]"""
    length: float
    """[m]"""


class Sphere(NamedTuple):
    """A ball about its centre."""

    radius: float
    """[m]"""


class UnknownShape(NamedTuple):
    """A shape of which no more is known than that it is there, such as a mesh in another file."""

    kind: str
    """its word in URDF"""


Shape = Box | Cylinder | Sphere | UnknownShape


class Visual(NamedTuple):
    """A shape at its place in the frame of a link."""

    shape: Shape
    color: Color
    place: Vector = (0.0, 0.0, 0.0)
    """[m]"""
    angles: Vector = (0.0, 0.0, 0.0)
    """roll, pitch and yaw [rad]"""
