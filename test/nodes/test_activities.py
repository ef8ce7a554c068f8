"""What nodes that command or drive tell of themselves for programs: activity, cause, who holds."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool

from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.sequence import SequenceNode
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode

SECOND = 1_000_000_000
NOON = 1434369600


class Alone:
    """A node in a graph of its own."""

    def __init__(self, kind, **given):
        self.now = 0.0
        self.graph = InProcessGraph(lambda *_: None, NOON * SECOND)
        self.node = InProcessNode(self.graph, kind, given)
        self.graph.start()

    def feed(self, topic, message, seconds=0.1):
        self.now += seconds
        header = getattr(message, 'header', None)
        if header is not None:
            header.stamp.sec = NOON + int(self.now)
            header.stamp.nanosec = int(self.now % 1.0 * 1e9)
        stamp = int((NOON + self.now) * SECOND)
        self.graph.feed(topic, stamp, codec(type(message)).encode(message))

    def run(self, seconds):
        self.now += seconds
        self.graph.run(int((NOON + self.now) * SECOND))

    @property
    def values(self):
        return self.node.plain.diagnose().values

    @property
    def doing(self):
        return self.values['activity'], self.values['because']


def odom(x=0.0):
    message = Odometry()
    message.header.frame_id = 'odom'
    message.pose.pose.position.x = x
    message.pose.pose.orientation.w = 1.0
    return message


def route(*places):
    message = Path()
    message.header.frame_id = 'odom'
    for x, y in places:
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y = x, y
        message.poses.append(pose)
    return message


def test_a_route_from_its_start_to_its_abort():
    robot = Alone(RouteFollowerNode)
    assert robot.doing == ('waiting', 'nothing')
    robot.feed('/odom', odom())
    robot.feed('/route', route((0.0, 0.0), (3.0, 0.0)))
    robot.feed('/odom', odom(0.01))
    assert robot.doing == ('driving', 'goal')
    since = float(robot.values['since [s]'])
    assert NOON <= since <= NOON + robot.now
    robot.node.plain._paused = True  # noqa: SLF001 - as its service sets it
    assert robot.doing == ('paused', 'person')
    robot.node.plain._paused = False  # noqa: SLF001
    robot.run(3.0)
    assert robot.doing == ('stopped', 'pose')
    robot.node.plain._on_abort(None)  # noqa: SLF001
    assert robot.doing == ('stopped', 'person')


def test_a_ghost_waits_for_a_goal_and_then_drives():
    robot = Alone(GhostTrajectory)
    assert robot.doing == ('waiting', 'nothing')
    robot.feed('/odom', odom())
    goal = PoseStamped()
    goal.header.frame_id = 'odom'
    goal.pose.position.x = 2.0
    robot.feed('/goal_pose', goal)
    robot.feed('/odom', odom(0.01))
    assert robot.doing == ('driving', 'goal')
    robot.run(3.0)
    assert robot.doing == ('stopped', 'pose')


def test_a_sequence_waits_for_its_start():
    assert Alone(SequenceNode).doing == ('waiting', 'nothing')


def twist(vx):
    message = TwistStamped()
    message.header.frame_id = 'base_link'
    message.twist.linear.x = vx
    return message


def wheels(names, rate, turned):
    angles = [turned] * len(names)
    return JointState(name=list(names), position=angles, velocity=[rate] * len(names))


@pytest.mark.parametrize('kind', [DifferentialKinematics, OmniKinematics])
def test_fixed_wheels_tell_who_holds_them_how_fast_they_are_and_what_they_hear(kind):
    robot = Alone(kind)
    assert robot.values['held by'] == 'nobody'
    assert 'encoders age [s]' not in robot.values
    robot.feed('/cmd_vel', twist(0.1))
    assert (robot.values['vx [m/s]'], robot.values['wz [rad/s]']) == ('0.10000', '0.00000')
    assert float(robot.values['commanded wheel speed [m/s]']) > 0.0
    assert robot.values['wheel speed [m/s]'] == '0.00000'
    names = robot.node.plain.parameters.joint_names
    for i in range(5):
        robot.feed('/wheels/state', wheels(names, 1.0, 0.02 * i), 0.02)
    assert float(robot.values['encoders age [s]']) < 0.1
    robot.feed('/standstill', Bool(data=True))
    assert robot.values['held by'] == 'arbiter'
    robot.feed('/standstill', Bool(data=False))
    robot.run(10.0)
    assert robot.values['held by'] == 'encoders'


def test_turrets_tell_who_holds_them():
    robot = Alone(WheelKinematics)
    assert robot.values['held by'] == 'nobody'
    names = [f'turret_{i}_{part}' for i in range(3) for part in ('steering', 'wheel')]
    for _ in range(3):
        state = JointState(name=names, position=[0.0] * 6, velocity=[0.0, 0.1] * 3)
        robot.feed('/turrets/state', state)
    assert robot.values['wheel speed [m/s]'] == '0.01000', '0.1 rad/s at a radius of 0.1 m'
    assert robot.values['commanded wheel speed [m/s]'] == '0.00000'
    robot.node.plain.note_residual(0.5)
    assert robot.values['held by'] == 'fight'
    robot.node.plain._guard._on_stop(type('Request', (), {'data': True}))  # noqa: SLF001
    assert robot.values['held by'] == 'person'


def test_probes_and_pose_tell_their_condition():
    values = Alone(GranierProbe, warm_up_days=0.0).values
    assert values['probe_2 condition'] == 'no reading'
    assert values['probe_2 signal'] == 's2'
    values = Alone(Localization).values
    assert (values['state'], values['pose told']) == ('waiting', 'no')
