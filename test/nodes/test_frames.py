"""Whatever robots stamp, and whatever they require, is in frames of their own."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.localization import Localization
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
"""A day in June on which the sap flows"""
OWN = {'base_link', 'odom', 'imu_link', 'probe_1', 'probe_2', 'probe_3'}


def frames_in(message):
    """Yield the names of frames in a message."""
    for name in ('header', 'child_frame_id'):
        value = getattr(message, name, '')
        frame = value if isinstance(value, str) else value.frame_id
        if frame:
            yield frame
    for many in ('poses', 'markers'):
        for part in getattr(message, many, ()):
            yield from frames_in(part) if hasattr(part, 'header') else ()


@pytest.fixture
def told_by(live_in_process):
    """Return what tells the frames that robots say, by namespace, and their complaints."""

    def told(robot, namespaces, seconds, **given):
        said = {name: set() for name in namespaces}

        def record(publisher, _, data):
            message = codec(publisher.kind).decode(data)
            said[publisher.port.namespace] |= set(frames_in(message))

        graph = live_in_process(robot, namespaces, record, seconds, all=given)
        return said, graph.complaints

    return told


@pytest.mark.parametrize('robot', ['tree', 'omni', 'differential'])
def test_robots_side_by_side_share_the_map_alone(robot, told_by):
    """One of them has no namespace: its frames are plain."""
    said, complaints = told_by(robot, ['/', '/oak'], 2.0)
    assert not [text for text in complaints if 'frame' in text]
    for namespace, frames in said.items():
        prefix = f'{namespace[1:]}/'.lstrip('/')
        assert {'map', f'{prefix}odom', f'{prefix}base_link'} <= frames
        assert frames <= {prefix + name for name in OWN} | {'map'}


@pytest.mark.parametrize(('prefix', 'expected'), [('/', ''), ('/pine/', 'pine/'), ('a_', 'a_')])
def test_a_prefix_that_is_given_reaches_every_node(prefix, expected, told_by):
    said, complaints = told_by('tree', ['/oak'], 1.0, frame_prefix=prefix)
    assert not [text for text in complaints if 'frame' in text]
    assert said['/oak'] <= {expected + name for name in OWN} | {'map'}
    assert f'{expected}odom' in said['/oak']


def one(kind, **given):
    """Return a node in the namespace oak, and what feeds it and tells its complaints."""
    graph = InProcessGraph(lambda *_: None, NOON)
    node = InProcessNode(graph, kind, given, {}, '/oak')
    graph.start()

    def feed(topic, message):
        before = sum(graph.complaints.values())
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(graph.now, SECOND)
        graph.feed(f'/oak/{topic}', graph.now + SECOND // 10, codec(type(message)).encode(message))
        return sum(graph.complaints.values()) == before

    return SimpleNamespace(node=node.plain, feed=feed, graph=graph)


def twist(frame):
    message = TwistStamped()
    message.header.frame_id = frame
    return message


def odometry(frame, child):
    message = Odometry(child_frame_id=child)
    message.header.frame_id = frame
    message.pose.pose.orientation.w = 1.0
    return message


@pytest.mark.parametrize(
    ('frame', 'taken'),
    [
        ('', True), ('base_link', True), ('/base_link', True), ('oak/base_link', True),
        ('/oak/base_link', True), ('ash/base_link', False), ('odom', False), ('oak/oak/x', False),
    ],
)  # fmt: skip
def test_a_twist_counts_in_the_robots_own_frame_alone(frame, taken):
    assert one(ArbiterNode).feed('cmd_vel/agent', twist(frame)) is taken


def test_odometry_of_another_robot_is_refused():
    robot = one(Localization)
    assert robot.feed('odom', odometry('odom', 'base_link'))
    assert robot.feed('odom', odometry('oak/odom', 'oak/base_link'))
    assert not robot.feed('odom', odometry('ash/odom', 'oak/base_link'))
    assert not robot.feed('odom', odometry('oak/odom', 'ash/base_link'))


@pytest.mark.parametrize(('frame', 'taken'), [('map', True), ('/map', True), ('oak/map', False)])
def test_the_map_is_that_of_all(frame, taken):
    fix = PoseWithCovarianceStamped()
    fix.header.frame_id = frame
    fix.pose.pose.orientation.w = 1.0
    fix.pose.covariance[0] = fix.pose.covariance[7] = 0.01
    assert one(Localization).feed('fix', fix) is taken


@pytest.mark.parametrize(
    ('given', 'frame', 'taken'),
    [
        ({}, 'odom', True), ({}, 'oak/odom', True), ({}, 'ash/odom', False), ({}, 'map', False),
        ({'position': 'pose', 'frame': 'map'}, 'map', True),
        ({'position': 'pose', 'frame': 'map'}, 'oak/odom', False),
    ],
)  # fmt: skip
def test_a_goal_counts_in_the_frame_in_which_the_robot_drives(given, frame, taken):
    goal = PoseStamped()
    goal.header.frame_id = frame
    goal.pose.orientation.w = 1.0
    robot = one(GhostTrajectory, **given)
    if given:
        assert robot.node.parameters.frame == 'map'
        pose = PoseWithCovarianceStamped()
        pose.header.frame_id = 'map'
        pose.pose.pose.orientation.w = 1.0
        assert robot.feed('pose', pose)
    else:
        assert robot.node.parameters.frame == 'oak/odom'
        assert robot.feed('odom', odometry('odom', 'base_link'))
    assert robot.feed('goal_pose', goal) is taken
