"""Limits of rates hold by the stamps of the commands, however long the machine takes in between."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped, Vector3Stamped

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
START = 1000 * SECOND


class SlowGraph(InProcessGraph):
    """A machine that is held up between any two looks at its clock, by 0 to 4 ms."""

    looks = _now = 0

    @property
    def now(self):
        """The time [ns], later at every look."""
        self.looks += 1
        self._now += self.looks * 7919 % 5 * 1_000_000
        return self._now

    @now.setter
    def now(self, value):
        self._now = max(value, self._now)  # it never goes back


class Rates:
    """A node on that machine, and the steps between its commands by their stamps."""

    def __init__(self, node, **given):
        self.commands = []
        self.graph = SlowGraph(self._record, START)
        InProcessNode(self.graph, node, given)
        self.graph.start()

    def _record(self, publisher, _, data):
        if publisher.topic == '/cmd_vel':
            message = codec(TwistStamped).decode(data)
            stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
            linear = message.twist.linear
            self.commands.append((stamp, hypot(linear.x, linear.y)))

    def say(self, topic, seconds, message):
        stamp = START + round(seconds * SECOND)
        message.header.stamp = stamp_of(stamp)
        self.graph.feed(topic, stamp, codec(type(message)).encode(message))

    def require(self, rate):
        assert len({speed for _, speed in self.commands}) > 5
        for (a, v), (b, w) in pairwise(self.commands):
            assert w - v <= rate * (b - a) + 1e-9


def test_of_the_arbiter():
    rates = Rates(ArbiterNode, **{'limits.linear_acceleration': 0.5})
    for i in range(25):
        message = TwistStamped()
        message.twist.linear.x = 0.6
        rates.say('/cmd_vel/agent', 0.1 * i, message)
    rates.require(0.5)


def test_of_the_motion_generator():
    """The rate is of v, and v = 1 is one metre a minute."""
    given = {'limits.v_rate': 0.5, 'goals.strategy': 'fixed', 'goal': (8.0, 5.0)}
    rates = Rates(MotionGenerator, **given)
    for i in range(25):
        pose, flow = PoseWithCovarianceStamped(), Vector3Stamped()
        pose.header.frame_id = 'map'
        pose.pose.pose.position.x = pose.pose.pose.position.y = 2.0
        pose.pose.pose.orientation.w = 1.0
        flow.vector.x = flow.vector.y = flow.vector.z = 1.0
        rates.say('/pose', 0.1 * i, pose)
        rates.say('/granier/sap_flow', 0.1 * i, flow)
    rates.require(0.5 / 60.0)
