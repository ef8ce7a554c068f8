"""What is no news moves nobody: repeats, old stamps, other frames, and clocks that go wrong."""

from __future__ import annotations

import time

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry, Path
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.differential_simulator import DifferentialSimulator
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.planar import Pose
from agv_motion.ros.diagnosis import ERROR, WARN
from agv_motion.ros.messages import TurretJoints, fill_path, seconds_of, stamp_of
from agv_motion.ros.qos import SENSOR

SECOND = 1_000_000_000
DRIVES = [
    pytest.param(DifferentialKinematics, 'wheels/command', id='differential'),
    pytest.param(OmniKinematics, 'wheels/command', id='omni'),
    pytest.param(WheelKinematics, 'turrets/command', id='turrets'),
]
LIMITS = {'report_after': 0.2, 'stop_after': 0.4}
EVERY = QoSProfile(depth=1000)
"""So that on a busy machine, too, no command is overwritten by the next before it is seen."""


class Driver:
    """Sends `cmd_vel` five times as often as the node needs it, with whatever stamp is set."""

    def __init__(self, tester, kind, topic, **parameters):
        self.tester = tester
        self.commands = tester.listen(JointState, topic, EVERY)
        self.node = tester.start(kind, **(LIMITS | parameters))
        self.cmd_vel = tester.publisher(TwistStamped, 'cmd_vel')
        self.offset, self.frame, self.frozen = 0.0, '', None
        tester.node.create_timer(0.04, self.send)

    def send(self):
        message = TwistStamped()
        message.header.frame_id = self.frame
        now = self.tester.node.get_clock().now().nanoseconds
        message.header.stamp = self.frozen or stamp_of(now + round(self.offset * SECOND))
        message.twist.linear.x = 0.02
        self.cmd_vel.publish(message)

    def moves(self):
        self.commands.clear()
        self.tester.wait(self.commands, lambda m: any(m.velocity))

    def stands(self):
        """Wait for a zero, and see that no other command follows."""
        self.commands.clear()
        self.tester.wait(self.commands, lambda m: not any(m.velocity))
        self.commands.clear()
        self.tester.wait(self.commands)
        assert not any(any(m.velocity) for m in self.commands)


@pytest.mark.parametrize(
    ('kind', 'topic', 'offset', 'word'),
    [
        (*DRIVES[0].values, -3600.0, 'stamped 3.6e+03 s ago, limit'),
        (*DRIVES[1].values, 3600.0, 's ahead, limit'),
        (*DRIVES[2].values, -3600.0, 'stamped 3.6e+03 s ago, limit'),
    ],
)
def test_a_twist_from_another_hour_is_refused_with_its_age(tester, kind, topic, offset, word):
    driver = Driver(tester, kind, topic)
    driver.moves()
    driver.offset = offset
    tester.graph.spin_until(lambda: word in driver.node.complaint)
    driver.stands()
    driver.offset = 0.0
    driver.moves()


@pytest.mark.parametrize(('kind', 'topic'), DRIVES)
def test_a_twist_again_and_again_with_one_stamp_is_silence(tester, kind, topic):
    driver = Driver(tester, kind, topic, max_age=60.0)
    driver.moves()
    driver.frozen = tester.node.get_clock().now().to_msg()
    driver.stands()


@pytest.mark.parametrize(('kind', 'topic'), DRIVES)
def test_after_a_nap_of_its_process_the_wheels_start_from_rest(tester, kind, topic):
    """The motors have stopped by themselves meanwhile, and a message is there at once."""
    slow = {'max_wheel_acceleration': 0.1} if topic == 'wheels/command' else {}
    driver = Driver(tester, kind, topic, **slow)
    driver.moves()
    node, slept = driver.node, [0.0]
    node.port.steady_seconds = lambda: time.monotonic() + slept[0]
    for _ in range(4):
        tester.wait(driver.commands, lambda m: max(m.velocity) > 0.1)
        now = node.port.nanoseconds() * 1e-9
        slept[0] += 10.0
        driver.commands.clear()
        first = tester.wait(driver.commands, lambda m: seconds_of(m.header.stamp) >= now)  # noqa: B023
        assert max(first.velocity) < 0.09  # a step of the ramp, or two


@pytest.mark.parametrize(('kind', 'topic'), DRIVES[1:])
def test_a_twist_in_another_frame_is_refused(tester, kind, topic):
    driver = Driver(tester, kind, topic)
    driver.frame = 'map'
    tester.graph.spin_until(lambda: "frame 'map': expected 'base_link'" in driver.node.complaint)
    driver.stands()
    driver.frame = 'base_link'
    driver.moves()
    command = driver.commands[-1]
    assert abs(seconds_of(command.header.stamp) - time.time()) < 10.0


def test_a_publisher_that_begins_anew_with_its_clock_set_back_is_obeyed_after_a_silence(tester):
    driver = Driver(tester, DifferentialKinematics, 'wheels/command', max_age=60.0)
    told = tester.logs()
    driver.offset = 5.0
    driver.moves()
    driver.offset = -5.0
    tester.wait(told, lambda m: 'its stamps went back by' in m.msg)
    driver.moves()


def test_odometry_that_repeats_itself_stops_the_route(tester):
    commands = tester.listen(TwistStamped, 'cmd_vel')
    tester.start(RouteFollowerNode, max_age=60.0, blocked__after=0.0, **LIMITS)
    odom = tester.publisher(Odometry, 'odom', SENSOR)
    route = tester.publisher(Path, 'route')
    message = Odometry()
    fresh = [True]

    def tell():
        if fresh[0]:
            message.header.stamp = tester.node.get_clock().now().to_msg()
            message.pose.pose.position.x += 0.002
        odom.publish(message)

    tester.node.create_timer(0.02, tell)
    way = Path()
    fill_path(way, [Pose(0.0, 0.0, 0.0), Pose(50.0, 0.0, 0.0)])
    tester.graph.repeat(
        lambda: route.publish(way), until=lambda: any(m.twist.linear.x for m in commands)
    )
    fresh[0] = False
    commands.clear()
    tester.wait(commands, lambda m: not m.twist.linear.x)
    commands.clear()
    tester.graph.spin_until(lambda: len(commands) > 5)
    assert not any(m.twist.linear.x for m in commands)


class SimulatedTime:
    """Tells /clock fifty times a second."""

    def __init__(self, tester):
        self.begin, self.stands, self.told = 1_000.0 - time.monotonic(), None, None
        self.clock = tester.publisher(Clock, '/clock', SENSOR)
        tester.node.create_timer(0.02, self.tell)

    def now(self):
        return self.stands or self.begin + time.monotonic()

    def tell(self):
        stamp = self.told or stamp_of(round(self.now() * SECOND))
        self.clock.publish(Clock(clock=stamp))


def fault_told(tester, driver, word, level=ERROR):
    """Wait until the diagnostics tell a fault of the clock, and no wheel turns."""
    told = tester.listen(DiagnosticArray, '/diagnostics', 10)
    driver.stands()
    found = tester.wait(told, lambda m: word in m.status[0].message)
    assert found.status[0].level == level


@pytest.mark.parametrize(('kind', 'topic'), DRIVES)
def test_a_node_on_simulated_time_without_a_clock_says_so_and_stands(tester, kind, topic):
    driver = Driver(tester, kind, topic, use_sim_time=True)
    fault_told(tester, driver, 'no time has come on /clock yet: waiting for it', WARN)


@pytest.mark.parametrize(('kind', 'topic'), DRIVES[::2])
def test_a_clock_that_goes_wrong_stops_the_wheels_until_it_runs_well(tester, kind, topic):
    """It leaps ahead, and back; stands; tells a negative time once."""
    driver = Driver(tester, kind, topic, use_sim_time=True)
    clock = SimulatedTime(tester)
    driver.offset = clock.begin - time.time() + time.monotonic()  # stamps of the same time

    def leap(seconds):
        clock.begin += seconds
        driver.offset += seconds

    driver.moves()
    for seconds in (500.0, -800.0):
        leap(seconds)
        driver.stands()
        driver.moves()
    clock.stands = clock.now()
    fault_told(tester, driver, 'the clock stands still at')
    clock.stands = None
    driver.moves()
    clock.told = stamp_of(-5 * SECOND)
    fault_told(tester, driver, '/clock told -5 s')
    clock.told = None
    driver.moves()


def turrets():
    joints = TurretJoints(3)
    joints.fill(message := joints.message(), [0.0] * 3, [0.1] * 3)
    return message


@pytest.mark.parametrize(
    ('kind', 'topic', 'command'),
    [
        (Simulator, 'turrets/command', turrets),
        (
            DifferentialSimulator,
            'wheels/command',
            lambda: JointState(name=['left_wheel', 'right_wheel'], velocity=[2.0, 2.0]),
        ),
        (
            OmniSimulator,
            'wheels/command',
            lambda: JointState(name=['wheel_0', 'wheel_1', 'wheel_2'], velocity=[2.0] * 3),
        ),
    ],
)
def test_motors_that_nobody_commands_stop(tester, kind, topic, command):
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    told = tester.logs()
    tester.start(kind, command_timeout=0.3)
    commands = tester.publisher(JointState, topic)

    def moves(message):
        twist = message.twist.twist
        return abs(twist.linear.x) + abs(twist.linear.y) + abs(twist.angular.z) > 1e-3

    tester.graph.repeat(lambda: commands.publish(command()), until=lambda: any(map(moves, truth)))
    tester.wait(told, lambda m: 'the motors stop' in m.msg)
    tester.graph.spin_until(lambda: not moves(truth[-1]))
