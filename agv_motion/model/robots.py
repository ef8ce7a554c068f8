"""The three robots of this package as links and joints, from the one description of each platform.

    tree           base_link ──> turret_i (steers about z) ──> wheel_i (rolls about y)
                             └─> trunk ──> probe_i
    omni           base_link ──> wheel_i, imu_link
    differential   base_link ──> left_wheel, right_wheel, caster

The base lies on the floor (REP-103: x forward, y left, z up), a wheel's frame in its centre, x
along the way it rolls when its rate is positive.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING

from agv_motion.model.robot_model import JointKind, RobotJoint, RobotLink, RobotModel
from agv_motion.model.shapes import Box, Cylinder, Visual

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
    from agv_motion.kinematics.omni_platform import OmniBaseParameters
    from agv_motion.kinematics.platform import PlatformParameters
    from agv_motion.model.shapes import Color
    from agv_motion.model.transform import Vector

UPRIGHT: Vector = (0.0, 0.0, 1.0)
AXLE: Vector = (0.0, 1.0, 0.0)
LYING: Vector = (pi / 2.0, 0.0, 0.0)
"""Roll that lays a cylinder along the axle"""
WOOD, NEEDLES, METAL, RUBBER, MARK = (
    (0.45, 0.32, 0.20, 1.0), (0.16, 0.37, 0.22, 1.0), (0.62, 0.64, 0.66, 1.0),
    (0.13, 0.13, 0.14, 1.0), (0.95, 0.77, 0.20, 1.0),
)  # fmt: skip
TRUNK, CROWN = 4.0, ((1.4, 1.0), (1.9, 0.85), (2.4, 0.65), (2.9, 0.45), (3.4, 0.25))
"""[m] height of the pine; height and radius of each whorl of its branches"""
PROBES = 3
"""in the trunk of a tree"""
BREAST_HEIGHT = 1.3
"""[m] at which probes are put into a trunk"""


def tree_model(given: PlatformParameters, base: str) -> RobotModel:
    """Return a pine on turrets; ``base`` is the frame of the platform."""
    radius, deck = given.wheel_radius, 2.5 * given.wheel_radius
    links = [RobotLink(base, (_disc(given.rim, 0.06, deck, WOOD),)), RobotLink('trunk', _pine())]
    joints = [_fixed('trunk', base, (0.0, 0.0, deck))]
    for i, (x, y) in enumerate(zip(given.turret_x, given.turret_y, strict=True)):
        turret, wheel = f'turret_{i}', f'wheel_{i}'
        links += [
            RobotLink(turret, (_disc(1.2 * radius, 0.04, 1.1 * radius, METAL),)),
            RobotLink(wheel, _wheel(radius)),
        ]
        joints += [
            RobotJoint(f'{turret}_steering', JointKind.CONTINUOUS, base, turret, (x, y, radius),
                       axis=UPRIGHT),
            RobotJoint(f'{turret}_wheel', JointKind.CONTINUOUS, turret, wheel, (0.0, 0.0, 0.0),
                       axis=AXLE),
        ]  # fmt: skip
    for i in range(PROBES):
        name, angle = f'probe_{i + 1}', 2.0 * pi * i / PROBES
        links.append(RobotLink(name))
        place = 0.12 * cos(angle), 0.12 * sin(angle), BREAST_HEIGHT - deck
        joints.append(_fixed(name, 'trunk', place, (0.0, 0.0, angle)))
    return RobotModel('tree', links, joints)


def omni_model(given: OmniBaseParameters, base: str) -> RobotModel:
    """Return a robot on omnidirectional wheels; ``base`` is its frame."""
    highest = max(given.wheel_radii)
    rim = max(given.wheel_distances) + highest
    links = [RobotLink(base, (_disc(rim, 0.03, 2.2 * highest, METAL),)), RobotLink('imu_link')]
    joints = [_fixed('imu_link', base, (0.0, 0.0, 2.2 * highest))]
    columns = (given.wheel_angles, given.wheel_distances, given.wheel_directions,
               given.wheel_radii, given.joint_names)  # fmt: skip
    for i, (angle, distance, direction, radius, joint) in enumerate(zip(*columns, strict=True)):
        place = distance * cos(angle), distance * sin(angle), radius
        links.append(RobotLink(f'wheel_{i}', _wheel(radius)))
        joints.append(_rolling(joint, base, f'wheel_{i}', place, direction))
    return RobotModel('omni', links, joints)


def differential_model(given: DifferentialBaseParameters, base: str) -> RobotModel:
    """Return a robot on two wheels; ``base`` is its frame, midway between them on the floor."""
    half, highest = 0.5 * given.track, max(given.wheel_radii)
    body = Visual(Box((2.4 * half, 1.7 * half, highest)), METAL, (0.0, 0.0, 1.4 * highest))
    caster = Visual(Cylinder(0.3 * highest, 0.6 * highest), RUBBER, (0.0, 0.0, 0.3 * highest))
    links = [RobotLink(base, (body,)), RobotLink('caster', (caster,))]
    joints = [_fixed('caster', base, (-0.9 * half, 0.0, 0.0))]
    sides = zip(('left_wheel', 'right_wheel'), given.joint_names, given.wheel_radii, (half, -half),
                strict=True)  # fmt: skip
    for link, joint, radius, y in sides:
        links.append(RobotLink(link, _wheel(radius)))
        joints.append(_rolling(joint, base, link, (0.0, y, radius), 0.0))
    return RobotModel('differential', links, joints)


def _fixed(child: str, parent: str, place: Vector, angles: Vector = (0.0, 0.0, 0.0)) -> RobotJoint:
    return RobotJoint(f'{child}_joint', JointKind.FIXED, parent, child, place, angles)


def _rolling(name: str, base: str, link: str, place: Vector, direction: float) -> RobotJoint:
    """Return the joint of a wheel that rolls in a ``direction`` [rad]."""
    angles = 0.0, 0.0, direction
    return RobotJoint(name, JointKind.CONTINUOUS, base, link, place, angles, AXLE)


def _disc(radius: float, thickness: float, height: float, color: Color) -> Visual:
    return Visual(Cylinder(radius, thickness), color, (0.0, 0.0, height))


def _wheel(radius: float) -> tuple[Visual, ...]:
    """Return a tyre, and a mark by which one sees it roll."""
    width = 0.6 * radius
    mark = Box((0.3 * radius, 1.1 * width, 0.3 * radius))
    return (
        Visual(Cylinder(radius, width), RUBBER, angles=LYING),
        Visual(mark, MARK, (0.0, 0.0, 0.75 * radius)),
    )


def _pine() -> tuple[Visual, ...]:
    def whorls() -> Iterator[Visual]:
        for height, radius in CROWN:
            yield _disc(radius, 0.3, height, NEEDLES)

    return (Visual(Cylinder(0.12, TRUNK), WOOD, (0.0, 0.0, 0.5 * TRUNK)), *whorls())
