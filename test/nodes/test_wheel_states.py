"""Readings of wheels become odometry, in a graph without middleware."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
START = 1000 * SECOND


class Base:
    """The node on a graph of its own: wheels of 5 cm, 30 cm apart."""

    def __init__(self):
        self.said = []
        self.graph = InProcessGraph(self.record, START)
        self.node = InProcessNode(self.graph, DifferentialKinematics, {})
        self.graph.start()

    def record(self, publisher, _, data):
        if publisher.topic == '/odom':
            self.said.append(codec(Odometry).decode(data))

    def read(self, tenth, left, right, names=('left_wheel', 'right_wheel'), **more):
        message = JointState(name=list(names), position=[left, right], **more)
        self.feed('/wheels/state', tenth, message)

    def feed(self, topic, tenth, message):
        stamp = START + tenth * SECOND // 10
        message.header.stamp = stamp_of(stamp)
        self.graph.feed(topic, stamp, codec(type(message)).encode(message))

    @property
    def last(self):
        return self.said[-1]


@pytest.fixture
def base():
    return Base()


def test_a_way_and_a_turn_by_hand(base):
    """A radian of both wheels is 5 cm; a radian more of the right one a third of 0.5 rad."""
    base.read(0, 0.0, 0.0)
    base.read(1, 1.0, 1.0)
    position = base.last.pose.pose.position
    assert (position.x, position.y) == pytest.approx((0.05, 0.0))
    assert base.last.twist.twist.linear.x == pytest.approx(0.5)
    base.read(2, 0.5, 1.5)
    assert base.last.twist.twist.angular.z == pytest.approx(10 * 0.05 / 0.3)
    assert base.last.pose.pose.orientation.z > 0.0
    assert (base.last.header.frame_id, base.last.child_frame_id) == ('odom', 'base_link')
    assert base.last.header.stamp == stamp_of(START + SECOND // 5)


def test_a_reading_that_cannot_be_is_refused_with_the_limit(base):
    base.read(0, 0.0, 0.0)
    base.read(1, 1.0, 1.0)
    count = len(base.said)
    base.read(2, 1000.0, 1.0)
    assert len(base.said) == count
    (told,) = [text for text in base.graph.complaints if 'max_wheel_speed' in text]
    assert 'look at the encoders' in told


def test_readings_of_other_joints_and_out_of_order_are_no_news(base):
    base.read(0, 0.0, 0.0)
    base.read(2, 1.0, 1.0)
    count = len(base.said)
    base.read(1, 0.5, 0.5)
    base.read(3, 2.0, 2.0, names=('a', 'b'))
    assert len(base.said) == count
    assert any('left_wheel' in text for text in base.graph.complaints)


def asked(x, variance=0.0, frame='odom'):
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x = x
    for place in (0, 7, 35):
        message.pose.covariance[place] = variance
    return message


def test_odometry_goes_on_from_a_pose_that_is_set(base):
    base.read(0, 0.0, 0.0)
    base.feed('/set_odometry', 0, asked(3.0, 0.25))
    base.read(1, 1.0, 1.0)
    assert base.last.pose.pose.position.x == pytest.approx(3.05)
    assert base.last.pose.covariance[0] == pytest.approx(0.25, rel=0.1)


@pytest.mark.parametrize(
    ('message', 'words'),
    [(asked(3.0, -1.0), 'not positive definite'), (asked(3.0, 0.1, 'map'), 'map')],
)
def test_a_pose_that_is_none_is_refused_and_nothing_moves(base, message, words):
    base.read(0, 0.0, 0.0)
    base.feed('/set_odometry', 0, message)
    base.read(1, 1.0, 1.0)
    assert base.last.pose.pose.position.x == pytest.approx(0.05)
    assert any(words in text for text in base.graph.complaints)
