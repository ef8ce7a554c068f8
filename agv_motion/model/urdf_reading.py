"""Links and joints from a URDF, whoever wrote it: what its transforms need, and what is seen of it.

Masses and limits are passed over. A document that declares entities is refused: unfolded,
a few lines of them fill any memory.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from math import isfinite
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError
from agv_motion.model.robot_model import (
    FORWARD,
    NO_ANGLES,
    JointKind,
    RobotJoint,
    RobotLink,
    RobotModel,
    unit,
)
from agv_motion.model.urdf_shapes import read_materials, read_visuals

if TYPE_CHECKING:
    from agv_motion.model.transform import Vector

LONGEST = 10_000_000
"""Characters of a document"""
MOST = 2000
"""Joints of a robot"""


def read_urdf(text: str) -> RobotModel:
    """Return the model that a URDF describes.

    Raises:
        ConfigurationError: It is no URDF, too large, or none that can be understood whole.

    """
    if len(text) > LONGEST or '<!' in text.replace('<!--', ''):
        msg = f'a robot description of {len(text)} characters: at most {LONGEST}, and no entities'
        raise ConfigurationError(msg)
    try:
        robot = ET.fromstring(text)  # noqa: S314 - no entities are in it
    except ET.ParseError as error:
        msg = f'the robot description is no XML: {error}'
        raise ConfigurationError(msg) from error
    joints = robot.findall('joint')
    if robot.tag != 'robot' or len(joints) > MOST:
        msg = f'<{robot.tag:.40}> with {len(joints)} joints: expected <robot> with at most {MOST}'
        raise ConfigurationError(msg)
    colors = read_materials(robot)
    links = [
        RobotLink(_attribute(link, 'name'), read_visuals(link, colors))
        for link in robot.findall('link')
    ]
    return RobotModel(robot.get('name', ''), links, [_joint(joint) for joint in joints])


def _joint(joint: ET.Element) -> RobotJoint:
    name, kind = _attribute(joint, 'name'), _attribute(joint, 'type')
    try:
        found = JointKind(kind)
    except ValueError:
        words = ', '.join(each.value for each in JointKind)
        msg = f'joint {name!r:.80} of the type {kind!r:.40}: understood are {words}'
        raise ConfigurationError(msg) from None
    origin = joint.find('origin')
    place = NO_ANGLES if origin is None else _vector(name, origin.get('xyz', '0 0 0'))
    angles = NO_ANGLES if origin is None else _vector(name, origin.get('rpy', '0 0 0'))
    told = joint.find('axis')
    axis = FORWARD if told is None else _vector(name, told.get('xyz', '1 0 0'))
    parent, child = (_attribute(_part(joint, part), 'link') for part in ('parent', 'child'))
    if found is not JointKind.FIXED:
        axis = unit(name, axis)
    return RobotJoint(name, found, parent, child, place, angles, axis)


def _part(element: ET.Element, tag: str) -> ET.Element:
    part = element.find(tag)
    if part is None:
        msg = f'joint {element.get("name", "")!r:.80} of the robot description has no <{tag}>'
        raise ConfigurationError(msg)
    return part


def _attribute(element: ET.Element, name: str) -> str:
    value = element.get(name)
    if not value:
        msg = f'a <{element.tag:.40}> of the robot description has no {name}'
        raise ConfigurationError(msg)
    return value


def _vector(joint: str, text: str) -> Vector:
    try:
        x, y, z = map(float, text.split())
    except ValueError:
        x = y = z = float('nan')
    if not isfinite(x + y + z):
        msg = f'joint {joint!r:.80}: {text!r:.80} are no three numbers'
        raise ConfigurationError(msg)
    return x, y, z
