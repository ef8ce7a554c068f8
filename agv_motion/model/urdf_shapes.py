"""What is to be seen of the links of a URDF, as far as it is understood.

Nothing is refused here: transforms hold, whatever a link looks like. What has no size that can be
read (a mesh in another file, a number that is none) is an `UnknownShape`, so that nobody takes the
rest of a robot for all of it.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from agv_motion.model.shapes import Box, Cylinder, Sphere, UnknownShape, Visual

if TYPE_CHECKING:
    import xml.etree.ElementTree as ET

    from agv_motion.model.shapes import Color, Shape

GREY: Color = (0.5, 0.5, 0.5, 1.0)
"""of what has no material"""


def read_materials(robot: ET.Element) -> dict[str, Color]:
    """Return the colours that a robot gives names to, at its top or in any visual."""
    found = {}
    for material in robot.iter('material'):
        color = _numbers(material.find('color'), 'rgba', 4)
        if color is not None:
            found[material.get('name', '')] = (color[0], color[1], color[2], color[3])
    return found


def read_visuals(link: ET.Element, materials: dict[str, Color]) -> tuple[Visual, ...]:
    """Return what is to be seen of a link; its collision shapes where nothing is."""
    elements = link.findall('visual') or link.findall('collision')
    return tuple(_visual(element, materials) for element in elements)


def _visual(element: ET.Element, materials: dict[str, Color]) -> Visual:
    material, origin = element.find('material'), element.find('origin')
    name = '' if material is None else material.get('name', '')
    place = (0.0, 0.0, 0.0) if origin is None else _numbers(origin, 'xyz', 3, '0 0 0')
    angles = (0.0, 0.0, 0.0) if origin is None else _numbers(origin, 'rpy', 3, '0 0 0')
    color = materials.get(name, GREY)
    if place is None or angles is None:
        return Visual(UnknownShape('origin'), color)
    shape = _shape(element.find('geometry'))
    return Visual(shape, color, (place[0], place[1], place[2]), (angles[0], angles[1], angles[2]))


def _shape(geometry: ET.Element | None) -> Shape:
    told = next(iter(geometry), None) if geometry is not None else None
    kind = 'nothing' if told is None else told.tag
    if kind == 'box' and (size := _numbers(told, 'size', 3)) is not None:
        return Box((size[0], size[1], size[2]))
    radius = _numbers(told, 'radius', 1)
    if kind == 'sphere' and radius is not None:
        return Sphere(radius[0])
    length = _numbers(told, 'length', 1)
    if kind == 'cylinder' and radius is not None and length is not None:
        return Cylinder(radius[0], length[0])
    return UnknownShape(kind)


def _numbers(
    element: ET.Element | None, name: str, count: int, default: str = ''
) -> tuple[float, ...] | None:
    """Return ``count`` finite numbers of an attribute; None where it has no such."""
    try:
        found = tuple(map(float, element.get(name, default).split())) if element is not None else ()
    except ValueError:
        return None
    return found if len(found) == count and all(map(isfinite, found)) else None
