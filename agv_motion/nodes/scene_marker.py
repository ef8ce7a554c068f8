"""A shape of the scene as a marker, for RViz and Foxglove."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from agv_motion.model.scene_shapes import ShapeKind

if TYPE_CHECKING:
    from agv_motion.model.scene_shapes import SceneShape

KINDS = {
    ShapeKind.LINE: Marker.LINE_STRIP, ShapeKind.PAIRS: Marker.LINE_LIST,
    ShapeKind.ARROW: Marker.ARROW, ShapeKind.TEXT: Marker.TEXT_VIEW_FACING,
    ShapeKind.TRIANGLES: Marker.TRIANGLE_LIST,
}  # fmt: skip


def marker_of(shape: SceneShape, number: int) -> Marker:
    """Return a shape as a marker without a header; ``number`` tells it from others of its name."""
    marker = Marker(ns=shape.namespace, id=number, type=KINDS[shape.kind], text=shape.text)
    marker.color = ColorRGBA(**dict(zip('rgba', shape.color, strict=True)))
    marker.pose.orientation.w = 1.0
    marker.scale.x = marker.scale.y = marker.scale.z = shape.width
    if shape.kind is ShapeKind.TEXT:
        place = marker.pose.position
        place.x, place.y, place.z = shape.points[0]
        return marker
    if shape.kind is ShapeKind.ARROW:
        marker.scale.y, marker.scale.z = 2.0 * shape.width, 0.0
    marker.points = [Point(x=x, y=y, z=z) for x, y, z in shape.points]
    return marker
