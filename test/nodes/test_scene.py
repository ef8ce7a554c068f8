"""The picture of a robot: every part in a namespace of its own, and none that is not there now."""

from __future__ import annotations

import json
from math import isfinite
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import Illuminance, JointState
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from agv_motion.nodes.scene import Scene, ShowParameters
from agv_motion.parameters import rows
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
ZONE = json.dumps({
    'boundary': [[0, 0], [20, 0], [20, 15], [0, 15]], 'margin': 0.5,
    'holes': [[[8, 8], [9, 8], [9, 9]]], 'translation_only': [[[2, 8], [6, 8], [6, 12]]],
})  # fmt: skip
ALL = {name for name, _, _ in rows(ShowParameters)}


def robot(**given):
    """Return a node, what feeds it, and what its picture consists of now."""
    pictures = []

    def record(_, __, data):
        pictures.append(codec(MarkerArray).decode(data).markers)

    graph = InProcessGraph(record, NOON)
    graph.recorded = ['/scene']
    node = InProcessNode(graph, Scene, given, {}, '/')
    graph.start()

    def feed(topic, message, frame=''):
        if hasattr(message, 'header'):
            message.header.stamp.sec, message.header.stamp.nanosec = divmod(graph.now, SECOND)
            message.header.frame_id = frame
        graph.feed(f'/{topic}', graph.now, codec(type(message)).encode(message))

    def wait(seconds):
        end = graph.now + round(seconds * SECOND)
        graph.run(end)
        graph.now = end

    def shown():
        found = {}
        for markers in pictures:
            for marker in markers:
                if marker.action == Marker.DELETE:
                    found.pop((marker.ns, marker.id))
                else:
                    found[marker.ns, marker.id] = marker
        return found

    return SimpleNamespace(node=node, feed=feed, wait=wait, shown=shown, pictures=pictures,
                           graph=graph)  # fmt: skip


def pose(x, y):
    message = PoseWithCovarianceStamped()
    message.pose.pose.position.x, message.pose.pose.position.y = x, y
    message.pose.pose.orientation.w = 1.0
    message.pose.covariance[0] = message.pose.covariance[7] = 0.01
    return message


def speak(one, *, x=5.0):
    """Let a robot say everything."""
    one.feed('zone', String(data=ZONE))
    one.feed('state', String(data='walking to sun: (9.0, 9.0)'))
    goal = PoseStamped()
    goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = 9.0, 9.0, 1.0
    one.feed('goal', goal, 'map')
    path = Path(poses=[PoseStamped(), goal])
    one.feed('path', path, 'map')
    move(one, x)


def move(one, x):
    one.feed('pose', pose(x, 5.0), 'map')
    one.feed('pose', pose(x + 1.0, 5.0), 'map')
    odometry = Odometry(child_frame_id='base_link')
    odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = 0.1, 0.1
    one.feed('odom', odometry, 'odom')
    names = [f'turret_{i}_{part}' for part in ('steering', 'wheel') for i in range(3)]
    one.feed('joint_states', JointState(name=names, position=[0.1] * 6, velocity=[1.0] * 6))
    one.feed('sunlight', Illuminance(illuminance=50_000.0))


def namespaces(one):
    return {namespace for namespace, _ in one.shown()}


def test_everything_is_in_the_picture_in_the_map_and_finite():
    one = robot()
    speak(one)
    one.wait(0.5)
    assert namespaces(one) == ALL
    for marker in one.shown().values():
        assert marker.header.frame_id == 'map'
        assert marker.points or marker.type == Marker.TEXT_VIEW_FACING
        assert all(isfinite(p.x + p.y + p.z) for p in [*marker.points, marker.pose.position])
        assert marker.color.a > 0.0 < marker.scale.x
    texts = {marker.text for marker in one.shown().values() if marker.text}
    assert texts == {'walking to sun: (9.0, 9.0)', 'in the sun, 50000 lx'}
    (margin,) = [m for (ns, _), m in one.shown().items() if ns == 'zone']
    assert {(p.x, p.y) for p in margin.points} == {(0, 0), (20, 0), (20, 15), (0, 15)}


def test_five_pictures_a_second_however_much_is_said():
    one = robot()
    for i in range(50):
        move(one, 0.1 * i)
        one.wait(0.02)
    assert len(one.pictures) == 5


@pytest.mark.parametrize('name', sorted(ALL))
def test_each_part_can_be_left_out_and_goes_at_once(name):
    one = robot()
    speak(one)
    one.wait(0.3)
    one.node.set_parameters({f'show.{name}': False})
    one.wait(0.3)
    assert namespaces(one) == ALL - {name}
    one.node.set_parameters({f'show.{name}': True})
    one.wait(0.3)
    assert namespaces(one) == ALL


def test_only_who_stands_in_the_sun_casts_a_shadow():
    one = robot()
    speak(one)
    one.feed('sunlight', Illuminance(illuminance=5_000.0))
    one.wait(0.3)
    assert namespaces(one) == ALL - {'shadow'}
    assert 'in the shade, 5000 lx' in {marker.text for marker in one.shown().values()}


def test_what_has_fallen_silent_is_deleted_and_comes_back():
    one = robot(stale_after=1.0)
    speak(one)
    one.wait(0.3)
    one.wait(1.5)
    assert namespaces(one) == {'zone', 'margin', 'holes', 'delicate', 'goal', 'path', 'trail'}
    move(one, 7.0)
    one.wait(0.3)
    assert namespaces(one) == ALL


def test_nothing_stays_behind_at_the_end():
    one = robot()
    speak(one)
    one.wait(0.3)
    one.graph.stop()
    assert one.shown() == {}


def test_what_is_no_place_and_what_is_no_zone_is_refused_and_the_picture_stays():
    one, nan = robot(), float('nan')
    speak(one)
    one.feed('pose', pose(nan, 5.0), 'map')
    one.feed('pose', pose(5.0, 5.0), 'odom')
    one.feed('zone', String(data='{"boundary": [[0, 0]]}'))
    one.feed('sunlight', Illuminance(illuminance=nan))
    one.feed('joint_states', JointState(name=['turret_0_wheel'], velocity=[nan], position=[nan]))
    one.wait(0.3)
    for marker in one.shown().values():
        assert all(isfinite(p.x + p.y + p.z) for p in [*marker.points, marker.pose.position])
    assert sum(one.graph.complaints.values()) >= 4
    assert {'zone', 'outline', 'sun'} <= namespaces(one)


@pytest.mark.parametrize('platform', ['omni', 'differential'])
def test_other_robots_have_their_wheels_too(platform):
    one = robot(platform=platform)
    move(one, 5.0)
    one.wait(0.3)
    bars = [m for (ns, _), m in one.shown().items() if ns == 'turrets']
    assert len(bars) >= (3 if platform == 'omni' else 2)
