"""What a robot is made of: links, and the joints between them, one tree from its base.

Names are those of the robot itself, without a prefix. As robot_state_publisher does, frames of
several robots are told apart by a prefix before the names of their links (`frames`).
"""

from __future__ import annotations

from enum import Enum
from math import isfinite, sqrt
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.model.transform import (
    NO_ROTATION,
    Transform,
    Vector,
    product,
    roll_pitch_yaw,
    rotated,
    turn,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from agv_motion.model.shapes import Visual
    from agv_motion.model.transform import Quaternion

NO_ANGLES: Vector = (0.0, 0.0, 0.0)
FORWARD: Vector = (1.0, 0.0, 0.0)
"""The axis of a joint that tells none, as URDF has it"""


class JointKind(Enum):
    """How a joint moves; the words are those of URDF."""

    FIXED = 'fixed'
    CONTINUOUS = 'continuous'
    """Turns about its axis, without end"""
    REVOLUTE = 'revolute'
    """Turns about its axis, within limits"""
    PRISMATIC = 'prismatic'
    """Slides along its axis"""


class RobotLink(NamedTuple):
    """A rigid part: a frame, and what is to be seen of it."""

    name: str
    visuals: tuple[Visual, ...] = ()


class RobotJoint(NamedTuple):
    """What holds the link `child` to the link `parent`."""

    name: str
    kind: JointKind
    parent: str
    child: str
    place: Vector
    """of the child in the parent [m]"""
    angles: Vector = NO_ANGLES
    """roll, pitch and yaw of the child in the parent, while the joint is at 0 [rad]"""
    axis: Vector = FORWARD
    """about which it turns, or along which it slides: a unit vector in the child"""

    def at(self, position: float) -> tuple[Vector, Quaternion]:
        """Return where the child is at a ``position`` of the joint [rad or m]."""
        still = roll_pitch_yaw(self.angles) if self.angles != NO_ANGLES else NO_ROTATION
        if self.kind is JointKind.FIXED:
            return self.place, still
        if self.kind is JointKind.PRISMATIC:
            x, y, z = rotated(still, self.axis)
            px, py, pz = self.place
            return (px + position * x, py + position * y, pz + position * z), still
        return self.place, product(still, turn(self.axis, position))


class RobotModel:
    """Links and joints of a robot."""

    def __init__(self, name: str, links: Sequence[RobotLink], joints: Sequence[RobotJoint]) -> None:
        """Keep them.

        Args:
            name: Of the robot.
            links: All of them.
            joints: Each of which holds one link to another.

        Raises:
            ConfigurationError: Two of them bear the same name, or they are no tree.

        """
        self.name, self.links, self.joints = name, tuple(links), tuple(joints)
        _require_distinct('links', [link.name for link in links])
        _require_distinct('joints', [joint.name for joint in joints])
        _require_distinct('joints for the link', [joint.child for joint in joints])
        self.root = self._root()
        """the link that no joint holds: the base"""
        self.moving = {j.name: j for j in self.joints if j.kind is not JointKind.FIXED}
        """joints whose positions must be told, by name"""

    def fixed(self, stamp: int, prefix: str) -> list[Transform]:
        """Return the transforms that hold for good, as of ``stamp`` [ns]."""
        return [
            Transform(stamp, prefix + j.parent, prefix + j.child, *j.at(0.0))
            for j in self.joints
            if j.kind is JointKind.FIXED
        ]

    def moved(self, stamp: int, prefix: str, positions: Mapping[str, float]) -> Iterator[Transform]:
        """Yield the transforms of joints at their ``positions`` [rad or m], by name.

        Positions of joints that it does not have, and those that are not finite, are passed over.
        """
        for name, position in positions.items():
            joint = self.moving.get(name)
            if joint is not None and isfinite(position):
                yield Transform(stamp, prefix + joint.parent, prefix + joint.child,
                                *joint.at(position))  # fmt: skip

    def _root(self) -> str:
        """Return the name of the one link that everything hangs on."""
        parents = {joint.child: joint.parent for joint in self.joints}
        names = [link.name for link in self.links]
        unknown = sorted(({*parents} | {*parents.values()}) - {*names})
        if unknown:
            msg = f'{self.name}: a joint holds the link {unknown[0]!r}, which there is not'
            raise ConfigurationError(msg)
        roots = [name for name in names if name not in parents]
        if len(roots) != 1:
            msg = f'{self.name}: its links hang on {roots or "each other in a circle"}, not on one'
            raise ConfigurationError(msg)
        for name in names:
            steps, at = 0, name
            while at in parents and steps <= len(names):
                steps, at = steps + 1, parents[at]
            if steps > len(names):
                msg = f'{self.name}: the link {name!r} hangs on itself, in a circle of joints'
                raise ConfigurationError(msg)
        return roots[0]


def unit(name: str, axis: Vector) -> Vector:
    """Return an axis of length 1.

    Raises:
        ConfigurationError: It has no direction; the message has the ``name``.

    """
    length = sqrt(sum(part * part for part in axis))
    if not (isfinite(length) and length > 1e-9):
        msg = f'joint {name!r}: its axis {axis} has no direction'
        raise ConfigurationError(msg)
    return axis[0] / length, axis[1] / length, axis[2] / length


def _require_distinct(what: str, names: Sequence[str]) -> None:
    """Raise where a name is borne twice."""
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        msg = f'two {what} {twice!r}: give each a name of its own'
        raise ConfigurationError(msg)
