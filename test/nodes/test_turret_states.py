"""States of turrets become residual and odometry: one by one and many together alike."""

from __future__ import annotations

from math import nan, pi

import pytest

pytest.importorskip('rclpy')

from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.reprocess.recorded import parameters
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import TurretJoints, stamp_of

SECOND = 1_000_000_000
START = 1000 * SECOND
JOINTS = codec(JointState)
KINDS = {'/odom': Odometry, '/turrets/residual': Float64}


class Tree:
    """The node on a graph of its own, as config/tree.yaml has it."""

    def __init__(self):
        self.said = {topic: [] for topic in KINDS}
        self.graph = InProcessGraph(self.record, START)
        self.given = parameters('tree.yaml', 'wheel_kinematics')
        self.node = InProcessNode(self.graph, WheelKinematics, self.given)
        self.count = len(self.node.plain.parameters.turret_x)
        self.radius = self.node.plain.parameters.wheel_radius
        self.zeros = self.node.plain.parameters.zeros()
        self.graph.start()

    def record(self, publisher, _, data):
        if publisher.topic in KINDS:
            self.said[publisher.topic].append(data)

    def state(self, tenth, angle, speed):
        """Return the bytes of a state in which every turret stands and rolls alike."""
        joints = TurretJoints(self.count)
        message = joints.message()
        rates = [speed / self.radius] * self.count
        joints.fill(message, [angle - zero for zero in self.zeros], rates)
        message.header.stamp = stamp_of(START + tenth * SECOND // 10)
        return JOINTS.encode(message)

    def feed(self, states, *, together=False):
        stamps = [START + i * SECOND // 10 for i in range(1, len(states) + 1)]
        if together:
            self.graph.look_ahead('/turrets/state', states, stamps)
        for stamp, state in zip(stamps, states, strict=True):
            self.graph.feed('/turrets/state', stamp, state)

    def told(self, topic):
        return [codec(KINDS[topic]).decode(data) for data in self.said[topic]]


def states(tree):
    return [tree.state(i, 0.1 * i, 0.05 + 0.01 * i) for i in range(1, 9)]


def test_turrets_that_agree_make_their_way_without_a_fight():
    """All at 90 degrees at 0.1 m/s: to the left, 1 cm in a tenth of a second."""
    tree = Tree()
    tree.feed([tree.state(i, pi / 2, 0.1) for i in range(1, 12)])
    last = tree.told('/odom')[-1]
    assert last.pose.pose.position.y == pytest.approx(0.1)
    assert last.pose.pose.position.x == pytest.approx(0.0, abs=1e-12)
    assert last.twist.twist.linear.y == pytest.approx(0.1)
    assert all(abs(fight.data) < 1e-12 for fight in tree.told('/turrets/residual'))


def test_many_together_are_the_same_bytes():
    one, many = Tree(), Tree()
    one.feed(states(one))
    many.feed(states(many), together=True)
    assert one.said == many.said
    assert len(one.said['/odom']) == 8


def test_a_state_that_is_no_number_is_refused_alone():
    tree = Tree()
    found = states(tree)
    message = JOINTS.decode(found[3])
    message.position[0] = nan
    found[3] = JOINTS.encode(message)
    tree.feed(found, together=True)
    assert len(tree.said['/odom']) in {6, 7}
    assert any('must be finite' in text for text in tree.graph.complaints)


def test_a_turret_that_pulls_the_other_way_is_a_fight():
    """One of them stands across: what no rigid body can do is left over."""
    tree = Tree()
    message = JOINTS.decode(tree.state(2, 0.0, 0.1))
    message.position[0] += pi / 2
    tree.feed([tree.state(1, 0.0, 0.1), JOINTS.encode(message)])
    assert tree.told('/turrets/residual')[-1].data > 0.02
