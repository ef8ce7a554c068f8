"""The picture of a scene shows the markers of its bag where they are, and nothing else."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import Point, PoseWithCovarianceStamped
from std_msgs.msg import ColorRGBA, String
from visualization_msgs.msg import Marker, MarkerArray

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.robots import tree_model
from agv_motion.model.scene_shapes import SceneShape, ShapeKind
from agv_motion.model.urdf import write_urdf
from agv_motion.nodes.scene_marker import marker_of
from agv_motion.report.scene_figure import ELEVATION, draw, read_scene, seen
from agv_motion.ros.cdr import codec

RED = (1.0, 0.0, 0.0, 1.0)
ZONE = SceneShape('zone', ShapeKind.LINE, ((0, 0, 0), (9, 0, 0), (9, 6, 0), (0, 0, 0)), RED)
SHAPES = [
    ZONE, SceneShape('icr', ShapeKind.PAIRS, ((1, 1, 0), (2, 1, 0), (3, 1, 0), (4, 1, 0)), RED),
    SceneShape('sun', ShapeKind.ARROW, ((4, 4, 5), (4, 4, 3)), RED),
    SceneShape('goal', ShapeKind.TEXT, ((5, 2, 1),), RED, 0.3, 'walking to the sun'),
    SceneShape('shadow', ShapeKind.TRIANGLES,
               ((3, 3, 0), (4, 3, 0), (4, 4, 0), (3, 3, 0), (4, 4, 0), (3, 4, 0)), RED),
]  # fmt: skip


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """The oak's zone after 0 s; after 1 s all else too; after 2 s the goal is deleted."""
    path = tmp_path_factory.mktemp('scene') / 'bag'
    gone = Marker(ns='goal', id=3, action=Marker.DELETE)
    odd = Marker(ns='cube', id=9, type=Marker.CUBE, color=ColorRGBA(a=1.0))
    odd.points = [Point(), Point()]
    all_of_it = [marker_of(shape, i) for i, shape in enumerate(SHAPES)]
    pose = PoseWithCovarianceStamped()
    pose.pose.pose.position.x, pose.pose.pose.position.y = 4.0, 3.0
    pose.pose.pose.orientation.w = 1.0
    urdf = write_urdf(tree_model(PlatformParameters(), 'base_link'))
    with BagWriter(path) as bag:
        scene = bag.add_topic('/oak/scene', 'visualization_msgs/msg/MarkerArray')
        for second, markers in enumerate([[marker_of(ZONE, 0)], [*all_of_it, odd], [gone]]):
            message = MarkerArray(markers=markers)
            bag.write(scene, second * 10**9, codec(MarkerArray).encode(message))
        for topic, kind, message in (
            ('/oak/robot_description', 'std_msgs/msg/String', String(data=urdf)),
            ('/oak/pose', 'geometry_msgs/msg/PoseWithCovarianceStamped', pose),
        ):
            told = bag.add_topic(topic, kind)
            bag.write(told, 0, codec(type(message)).encode(message))
    return path


def scene_at(bag, seconds):
    with BagReader(bag) as reader:
        return read_scene(reader, seconds)


def test_a_scene_is_what_was_told_until_then(bag):
    assert [marker.namespace for marker in scene_at(bag, 0.5).markers] == ['zone']
    names = [marker.namespace for marker in scene_at(bag, 1.5).markers]
    assert names == ['zone', 'icr', 'sun', 'goal', 'shadow']
    assert 'goal' not in {marker.namespace for marker in scene_at(bag, 9.0).markers}


def test_before_anything_was_told_there_is_no_scene(bag):
    with pytest.raises(ConfigurationError, match='nobody told a scene in the first -1 s'):
        scene_at(bag, -1.0)


def test_the_robot_stands_where_it_believed_to_be(bag):
    solids = scene_at(bag, 1.0).solids
    deck = max(solids, key=lambda solid: np.ptp(solid.corners[:, 0]))
    assert deck.corners.mean(axis=0) == pytest.approx([4.0, 3.0, 0.25])
    assert np.ptp(deck.corners[:, 0]) == pytest.approx(2 * 1.18)
    assert max(solid.corners[:, 2].max() for solid in solids) == pytest.approx(4.25)


def test_a_place_is_seen_from_the_south():
    """What is higher or farther north is higher on the picture; east is right."""
    places = [(1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 3.0)]
    expected = [[1.0, 0.0], [0.0, 2.0 * sin(ELEVATION)], [0.0, 3.0 * cos(ELEVATION)]]
    assert seen(places) == pytest.approx(np.array(expected))


def test_each_marker_is_drawn_where_it_is(bag, tmp_path, sketched):
    scene = scene_at(bag, 1.5)
    draw(scene, 'a scene', tmp_path / 'scene.png', theme='dark')
    ((drawn, _),) = sketched
    (axes,) = drawn.axes

    def found(name):
        return axes.findobj(lambda artist: artist.get_gid() == name)

    (zone,), (goal,), (shadow,) = found('zone'), found('goal'), found('shadow')
    assert zone.get_xydata() == pytest.approx(seen(ZONE.points))
    assert goal.get_text() == 'walking to the sun'
    assert goal.get_position() == pytest.approx(tuple(seen([(5, 2, 1)])[0]))
    x, y = shadow.get_xy().T
    assert (x.min(), x.max(), y.min(), y.max()) == pytest.approx(
        (3.0, 4.0, 3.0 * sin(ELEVATION), 4.0 * sin(ELEVATION))
    )
    assert [tuple(line.get_xdata()) for line in found('icr')] == [(1.0, 2.0), (3.0, 4.0)]
    assert len(found('sun')) >= 1
    assert not found('cube')
    texts = {text.get_text() for text in drawn.legends[0].get_texts()}
    assert texts == {'zone', 'icr', 'sun', 'goal', 'shadow'}
    box = goal.get_window_extent()
    assert axes.bbox.x0 <= box.x0 < box.x1 <= axes.bbox.x1
