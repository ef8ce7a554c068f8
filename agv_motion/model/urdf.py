"""A robot as URDF, for tools that draw it: plain XML, from its links and joints.

The names of links have no prefix: as with robot_state_publisher, whoever draws several robots is
told the prefix of each beside its description (RViz: TF Prefix; Foxglove: frame prefix).
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from typing import TYPE_CHECKING

from agv_motion.model.robot_model import JointKind
from agv_motion.model.shapes import Box, Cylinder, Sphere

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.model.robot_model import RobotJoint, RobotModel
    from agv_motion.model.shapes import Color, Visual
    from agv_motion.model.transform import Vector


def write_urdf(model: RobotModel) -> str:
    """Return a model as URDF; numbers are written whole, so that nothing is lost."""
    robot = ET.Element('robot', name=model.name)
    colors = {visual.color: '' for link in model.links for visual in link.visuals}
    for i, color in enumerate(colors):
        colors[color] = f'material_{i}'
        material = ET.SubElement(robot, 'material', name=colors[color])
        ET.SubElement(material, 'color', rgba=_words(color))
    for link in model.links:
        element = ET.SubElement(robot, 'link', name=link.name)
        for visual in link.visuals:
            _add_visual(element, visual, colors)
    for joint in model.joints:
        _add_joint(robot, joint)
    ET.indent(robot)
    return ET.tostring(robot, encoding='unicode', xml_declaration=False)


def _add_visual(link: ET.Element, visual: Visual, colors: dict[Color, str]) -> None:
    element = ET.SubElement(link, 'visual')
    _add_origin(element, visual.place, visual.angles)
    geometry, shape = ET.SubElement(element, 'geometry'), visual.shape
    if isinstance(shape, Box):
        ET.SubElement(geometry, 'box', size=_words(shape.size))
    elif isinstance(shape, Cylinder):
        ET.SubElement(geometry, 'cylinder', radius=repr(shape.radius), length=repr(shape.length))
    elif isinstance(shape, Sphere):
        ET.SubElement(geometry, 'sphere', radius=repr(shape.radius))
    else:
        ET.SubElement(geometry, shape.kind)
    ET.SubElement(element, 'material', name=colors[visual.color])


def _add_joint(robot: ET.Element, joint: RobotJoint) -> None:
    element = ET.SubElement(robot, 'joint', name=joint.name, type=joint.kind.value)
    ET.SubElement(element, 'parent', link=joint.parent)
    ET.SubElement(element, 'child', link=joint.child)
    _add_origin(element, joint.place, joint.angles)
    if joint.kind is not JointKind.FIXED:
        ET.SubElement(element, 'axis', xyz=_words(joint.axis))


def _add_origin(element: ET.Element, place: Vector, angles: Vector) -> None:
    ET.SubElement(element, 'origin', xyz=_words(place), rpy=_words(angles))


def _words(numbers: Sequence[float]) -> str:
    return ' '.join(map(repr, map(float, numbers)))
