"""A robot seen from above, at its true size: what its links cover of the floor."""

from __future__ import annotations

from itertools import product as every
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING, NamedTuple

import shapely

from agv_motion.model.robot_model import JointKind
from agv_motion.model.shapes import Box, Cylinder, Sphere, UnknownShape
from agv_motion.model.transform import NO_ROTATION, product, roll_pitch_yaw, rotated

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from agv_motion.model.robot_model import RobotJoint, RobotModel
    from agv_motion.model.shapes import Color, Visual
    from agv_motion.model.transform import Quaternion, Vector
    from agv_motion.planar import Pose

    Point = tuple[float, float]
    Outline = tuple[Point, ...]
    Frame = tuple[Vector, Quaternion]

CORNERS = 48
"""of a circle"""
UPRIGHT = 0.7
"""[-] Height of a unit vector from which an axis is upright: what turns about it does not roll."""


class Footprint(NamedTuple):
    """What a robot covers of the floor: corners in its own frame, or in the map, x and y [m]."""

    body: Outline
    """convex, about all that is fixed to the base"""
    turrets: tuple[Outline, ...] = ()
    """what else moves"""
    wheels: tuple[Outline, ...] = ()
    """what rolls about a level axle, as it is steered now"""

    @property
    def reach(self) -> float:
        """How far the robot reaches from its centre, while it stands in its own frame [m]."""
        outlines = (self.body, *self.turrets, *self.wheels)
        return max(hypot(x, y) for outline in outlines for x, y in outline)

    def at(self, pose: Pose) -> Footprint:
        """Return the same robot where it stands in the map."""
        c, s = cos(pose.theta), sin(pose.theta)

        def laid(outline: Outline) -> Outline:
            return tuple((pose.x + c * x - s * y, pose.y + s * x + c * y) for x, y in outline)

        return Footprint(
            laid(self.body), tuple(map(laid, self.turrets)), tuple(map(laid, self.wheels))
        )


def steering_joints(model: RobotModel) -> list[str]:
    """Return the joints under which something rolls and which stand upright, by name."""
    above = {joint.parent for joint in model.joints if _rolls(joint)}
    return [name for name, joint in model.moving.items() if joint.child in above]


def footprint(model: RobotModel, positions: Mapping[str, float]) -> Footprint | None:
    """Return what a robot covers of the floor; None where its model does not tell its size.

    Args:
        model: Links and joints.
        positions: Of its joints [rad or m], by name. Wheels under a joint that steers are left out
            where its angle is missing; where that of any other joint is missing it is at 0.

    """
    joints = {joint.child: joint for joint in model.joints}
    steering = {*steering_joints(model)}
    visuals = {link.name: link.visuals for link in model.links}
    body: list[Point] = []
    turrets: list[Outline] = []
    wheels: list[Outline] = []
    for link, seen in visuals.items():
        above = list(_above(link, joints))
        moving = [joint for joint in above if joint.kind is not JointKind.FIXED]
        unknown = any(isinstance(visual.shape, UnknownShape) for visual in seen)
        if unknown and not moving:
            return None
        if unknown or any(j.name in steering and j.name not in positions for j in moving[1:]):
            continue
        frame = _frame(above, positions)
        corners = [(x, y) for visual in seen for x, y, _ in _corners(visual, frame)]
        if not moving:
            body += corners
        elif corners:
            (wheels if _rolls(moving[0]) else turrets).append(_hull(corners))
    return Footprint(_hull(body), tuple(turrets), tuple(wheels)) if body else None


def solids(model: RobotModel) -> Iterator[tuple[list[Vector], Color]]:
    """Yield corners [m] and colour of each convex part that is fixed to the base, seen from it."""
    joints = {joint.child: joint for joint in model.joints}
    for link in model.links:
        above = list(_above(link.name, joints))
        if all(joint.kind is JointKind.FIXED for joint in above):
            frame = _frame(above, {})
            for visual in link.visuals:
                if corners := list(_corners(visual, frame)):
                    yield corners, visual.color


def corners_above(model: RobotModel) -> list[Vector]:
    """Return corners of all that is fixed to the base, seen from there [m]: what casts a shadow."""
    return [corner for corners, _ in solids(model) for corner in corners]


def disc(radius: float) -> Footprint:
    """Return a round robot of which no more is known than how far it reaches [m]."""
    return Footprint(tuple(_circle(radius)))


def _rolls(joint: RobotJoint) -> bool:
    """Whether a joint turns about a level axle, as seen from its parent."""
    turns = joint.kind in {JointKind.CONTINUOUS, JointKind.REVOLUTE}
    return turns and abs(rotated(roll_pitch_yaw(joint.angles), joint.axis)[2]) < UPRIGHT


def _above(link: str, joints: Mapping[str, RobotJoint]) -> Iterator[RobotJoint]:
    """Yield the joints from a link up to the base."""
    while link in joints:
        yield joints[link]
        link = joints[link].parent


def _frame(above: list[RobotJoint], positions: Mapping[str, float]) -> Frame:
    """Return place and rotation of a link in the base, from the joints up to there."""
    place, rotation = (0.0, 0.0, 0.0), NO_ROTATION
    for joint in above:
        at, turned = joint.at(positions.get(joint.name, 0.0))
        x, y, z = rotated(turned, place)
        place, rotation = (at[0] + x, at[1] + y, at[2] + z), product(turned, rotation)
    return place, rotation


def _corners(visual: Visual, frame: Frame) -> Iterator[Vector]:
    """Yield corners of a shape in the base; from above, their convex hull is what it covers."""
    place, rotation = frame
    x, y, z = rotated(rotation, visual.place)
    centre = place[0] + x, place[1] + y, place[2] + z
    turned = product(rotation, roll_pitch_yaw(visual.angles))
    round_about = isinstance(visual.shape, Sphere)
    for corner in _points(visual):
        x, y, z = corner if round_about else rotated(turned, corner)
        yield centre[0] + x, centre[1] + y, centre[2] + z


def _points(visual: Visual) -> Iterator[Vector]:
    shape = visual.shape
    if isinstance(shape, Box):
        yield from every(*((-0.5 * side, 0.5 * side) for side in shape.size))
    elif isinstance(shape, Cylinder):
        for x, y in _circle(shape.radius):
            yield x, y, 0.5 * shape.length
            yield x, y, -0.5 * shape.length
    elif isinstance(shape, Sphere):
        for x, y in _circle(shape.radius):
            yield x, y, 0.0


def _circle(radius: float) -> Iterator[Point]:
    turns = (2.0 * pi * i / CORNERS for i in range(CORNERS))
    return ((radius * cos(turn), radius * sin(turn)) for turn in turns)


def _hull(points: list[Point]) -> Outline:
    ring = shapely.MultiPoint(points).convex_hull
    corners = getattr(ring, 'exterior', ring).coords
    return tuple((float(x), float(y)) for x, y in corners)
