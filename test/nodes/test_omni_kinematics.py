"""Node `omni_kinematics` over a real graph: wheels, odometry, and what befalls encoders."""

from __future__ import annotations

from itertools import count, pairwise
from math import asin, inf, nan, pi, sqrt

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import SetBool

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.ros.diagnosis import OK, WARN
from agv_motion.ros.messages import seconds_of
from agv_motion.ros.qos import SENSOR
from agv_motion.ros.run import StartError

RADIUS, DISTANCE = 0.05, 0.2
MECANUM = {
    'wheel_angles': [pi / 4, -pi / 4, 3 * pi / 4, -3 * pi / 4],
    'wheel_distances': [0.3] * 4,
    'wheel_directions': [0.0] * 4,
    'slide_angles': [pi / 4, -pi / 4, -pi / 4, pi / 4],
    'wheel_radii': [RADIUS] * 4,
    'joint_names': ['a', 'b', 'c', 'd'],
}
UNRAMPED = {'max_wheel_acceleration': 0.0, 'max_wheel_deceleration': 0.0}
PATIENT = {'report_after': 20.0, 'stop_after': 20.0}


def twist(vx=0.0, vy=0.0, wz=0.0):
    message = TwistStamped()
    message.twist.linear.x, message.twist.linear.y, message.twist.angular.z = vx, vy, wz
    return message


def state(angles, stamp, names=('wheel_0', 'wheel_1', 'wheel_2'), rates=()):
    message = JointState(name=names, position=angles, velocity=rates)
    message.header.stamp.sec, rest = divmod(round(stamp * 1e9), 1_000_000_000)
    message.header.stamp.nanosec = rest
    return message


def nanoseconds(header):
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


class Robot:
    """The node, its outputs, and hands to move its wheels."""

    def __init__(self, tester, **parameters):
        self.tester = tester
        self.commands = tester.listen(JointState, 'wheels/command')
        self.odometry = tester.listen(Odometry, 'odom', SENSOR)
        self.node = tester.start(OmniKinematics, max_age=1e10, **parameters)
        self.cmd_vel = tester.publisher(TwistStamped, 'cmd_vel')
        self.encoders = tester.publisher(JointState, 'wheels/state', SENSOR)

    def drive(self, **components):
        """Return the command that answers a twist: the first that is stamped no sooner."""
        watch = self.node.plain.guard.command
        before = watch.newest
        self.commands.clear()
        self.tester.graph.repeat(
            lambda: self.cmd_vel.publish(twist(**components)), until=lambda: watch.newest > before
        )
        return self.tester.wait(self.commands, lambda m: nanoseconds(m.header) >= watch.newest)

    def tell(self, message):
        self.odometry.clear()
        self.encoders.publish(message)
        return self.tester.wait(self.odometry)

    def tell_silently(self, message):
        self.odometry.clear()
        self.encoders.publish(message)
        self.tester.graph.spin_for(0.1)
        assert not self.odometry


def test_the_wheels_of_the_seed(tester):
    """Hand calculation: V = sin(a) vx - cos(a) vy - d wz at 30, 150 and 270 degrees."""
    robot = Robot(tester, **PATIENT, **UNRAMPED)
    command = robot.drive(vx=0.3, vy=0.1, wz=0.5)
    half, root = 0.5, sqrt(3.0) / 2.0
    expected = [
        half * 0.3 - root * 0.1 - DISTANCE * 0.5,
        half * 0.3 + root * 0.1 - DISTANCE * 0.5,
        -0.3 - DISTANCE * 0.5,
    ]
    assert list(command.name) == ['wheel_0', 'wheel_1', 'wheel_2']
    assert list(command.velocity) == pytest.approx([v / RADIUS for v in expected])


def test_beyond_the_limit_all_wheels_are_scaled(tester):
    plain = tester.listen(Float64MultiArray, 'wheels/velocity_commands')
    robot = Robot(tester, max_wheel_speed=0.5, **PATIENT, **UNRAMPED)
    tester.graph.spin_for(0.2)
    command = robot.drive(vx=2.0)
    assert list(command.velocity) == pytest.approx([5.0, 5.0, -10.0])
    told = tester.wait(plain, lambda m: any(m.data))
    assert list(told.data) == pytest.approx([5.0, 5.0, -10.0])


def test_a_step_told_once_is_ramped_in_its_own_direction(tester):
    """The third wheel is the fastest, and speeds up with 0.5 m/s2; the others keep their share."""
    robot = Robot(tester, max_wheel_acceleration=0.5, **PATIENT)
    robot.drive(vx=0.3, vy=0.1, wz=0.5)
    tester.wait(robot.commands, lambda m: m.velocity[2] * RADIUS == pytest.approx(-0.4))
    ramp = [[rate * RADIUS for rate in m.velocity] for m in robot.commands]
    assert len(ramp) > 10
    times = [seconds_of(m.header.stamp) for m in robot.commands]
    for (before, first), (after, second) in pairwise(zip(times, ramp, strict=True)):
        assert abs(second[2] - first[2]) <= 0.5 * (after - before) + 1e-6
    for first, second, third in ramp:
        assert first == pytest.approx(third * 0.036603 / 0.4, abs=1e-6)
        assert second == pytest.approx(-third * 0.136603 / 0.4, abs=1e-6)


@pytest.mark.parametrize('bad', [nan, inf])
def test_a_twist_that_is_no_number_is_refused(tester, bad):
    robot = Robot(tester, **PATIENT)
    robot.commands.clear()
    robot.cmd_vel.publish(twist(vy=bad))
    tester.graph.spin_until(lambda: 'must be finite' in robot.node.complaint)
    assert not [m for m in robot.commands if any(m.velocity)]


def test_silence_stop_and_the_end_are_explicit_zeros(tester):
    robot = Robot(tester, report_after=0.1, stop_after=0.2)
    assert any(robot.drive(vx=0.3).velocity)
    robot.commands.clear()
    tester.wait(robot.commands, lambda m: not any(m.velocity))
    assert tester.ask(SetBool, 'omni_kinematics/stop', SetBool.Request(data=True)).success
    assert not any(robot.drive(vx=0.3).velocity)
    assert tester.ask(SetBool, 'omni_kinematics/stop', SetBool.Request(data=False)).success
    assert any(robot.drive(vx=0.3).velocity)
    robot.commands.clear()
    robot.node.trigger_deactivate()
    tester.graph.spin_until(lambda: robot.commands)
    assert list(robot.commands[-1].velocity) == [0.0] * 3


@pytest.mark.parametrize(
    ('speed', 'found'), [(0.2, (WARN, 'cmd_vel is lost')), (0.0, (OK, 'standing'))]
)
def test_silence_is_worth_a_warning_only_where_the_robot_was_driven(tester, speed, found):
    robot = Robot(tester, report_after=0.1, stop_after=0.2)
    robot.drive(vx=speed)
    tester.graph.spin_for(0.5)
    tester.graph.spin_until(lambda: robot.node.plain.diagnose()[:2] == found)


def test_encoders_that_fall_silent_stop_the_robot(tester):
    robot = Robot(tester, report_after=0.1, stop_after=0.3)
    robot.tell(state([0.0] * 3, 1.0))
    tester.graph.repeat(
        lambda: robot.drive(vx=0.3),
        until=lambda: 'wheels/state is lost' in robot.node.plain.diagnose().message,
    )
    assert not any(robot.drive(vx=0.3).velocity)
    stamps = count(2)

    def speak():
        robot.encoders.publish(state([0.0] * 3, next(stamps)))
        robot.drive(vx=0.3)

    tester.graph.repeat(speak, until=lambda: any(robot.commands[-1].velocity))


def test_odometry_tells_pose_twist_covariance_rollers_and_slip(tester):
    """Hand calculation: all rims 0.02 m forward turn the base by -0.02 / 0.2 rad."""
    free = tester.listen(JointState, 'wheels/free_speed', SENSOR)
    slip = tester.listen(Float64, 'wheels/residual', SENSOR)
    robot = Robot(tester, **PATIENT)
    robot.tell(state([1.0, 2.0, 3.0], 5.0))
    odometry = robot.tell(state([1.4, 2.4, 3.4], 5.1))
    assert odometry.pose.pose.orientation.z == pytest.approx(-0.05, abs=1e-4)
    assert odometry.twist.twist.angular.z == pytest.approx(-1.0)
    assert (odometry.header.frame_id, odometry.child_frame_id) == ('odom', 'base_link')
    assert odometry.pose.covariance[35] == pytest.approx(0.005**2 * 0.02 / 3 / 0.04)
    assert odometry.twist.covariance[35] == pytest.approx(odometry.pose.covariance[35] / 0.01)
    assert tester.wait(slip).data == 0.0
    # forward, by (V_A + V_B - 2 V_C) / 3, the roller of wheel A runs (V_B - V_C) / sqrt(3)
    robot.tell(state([1.5, 2.5, 3.2], 5.2))
    rollers = tester.wait(free, lambda m: max(m.velocity) > 0.01)
    assert rollers.velocity[0] == pytest.approx((0.05 + 0.1) / sqrt(3.0))


def test_rates_alone_will_do(tester):
    robot = Robot(tester, **PATIENT)
    for stamp in (1.0, 1.1, 1.2):
        odometry = robot.tell(state([], stamp, rates=[2.0, 2.0, 2.0]))
    assert odometry.twist.twist.angular.z == pytest.approx(-2.0 * RADIUS / DISTANCE)


def test_whichever_field_is_of_use_carries_the_odometry_on(tester):
    """At 2 rad/s of all wheels: positions of use, then rates alone, then positions again."""
    robot = Robot(tester, **PATIENT)
    fields = [('both', 1.0), ('position', 1.1), ('rate', 1.2), ('rate', 1.3), ('position', 1.4)]
    for field, stamp in fields:
        angles = [nan if field == 'rate' else 50.0 + 2.0 * (stamp - 1.0)] * 3
        rates = [nan if field == 'position' else 2.0] * 3
        odometry = robot.tell(state(angles, stamp, rates=rates))
    turned = -2.0 * 0.4 * RADIUS / DISTANCE
    assert 2.0 * asin(odometry.pose.pose.orientation.z) == pytest.approx(turned, abs=1e-6)
    assert 'velocities must be finite' in robot.node.complaint


def test_stamps_and_encoders_that_jump(tester):
    robot = Robot(tester, odometry__encoder_range=2 * pi, **PATIENT)
    robot.tell(state([6.2, 0.0, 0.0], 1.0))
    wrapped = robot.tell(state([0.1, 0.0, 0.0], 1.1))  # went on by 0.183
    turn = -RADIUS * (0.1 + 2 * pi - 6.2) / (3 * DISTANCE)
    assert wrapped.twist.twist.angular.z == pytest.approx(turn / 0.1)
    robot.tell_silently(state([0.2, 0.0, 0.0], 1.1))  # the stamp again
    robot.tell_silently(state([0.2, 0.0, 0.0], 0.9))  # out of order
    same = robot.tell(state([0.1, 0.0, 0.0], 1.2))
    assert same.pose.pose.orientation.z == pytest.approx(wrapped.pose.pose.orientation.z)


def test_an_encoder_that_begins_again_moves_nobody_and_costs_certainty(tester):
    robot = Robot(tester, odometry__max_wheel_speed=1.0, **PATIENT)
    robot.tell(state([100.0] * 3, 1.0))
    before = robot.tell(state([101.0] * 3, 1.1))
    robot.tell_silently(state([0.0] * 3, 1.2))
    assert 'cannot follow the last' in robot.node.complaint
    after = robot.tell(state([0.0] * 3, 1.3))
    assert after.pose.pose == before.pose.pose
    assert after.pose.covariance[35] > before.pose.covariance[35]


@pytest.mark.parametrize(
    ('message', 'word'),
    [
        (state([0.0, nan, 0.0], 2.0), 'positions must be finite'),
        (state([0.0, 0.0], 2.0), '2 positions for 3 joints'),
        (state([], 2.0), 'neither positions nor velocities'),
        (state([0.0] * 3, 2.0, names=('x', 'y', 'z')), 'set joint_names'),
        (state([0.0] * 2, 2.0, names=('wheel_0', 'wheel_2')), 'cannot tell a twist'),
    ],
)
def test_a_state_that_does_not_fit_is_refused(tester, message, word):
    robot = Robot(tester, **PATIENT)
    robot.tell(state([0.0] * 3, 1.0))
    robot.encoders.publish(message)
    tester.graph.spin_until(lambda: word in robot.node.complaint)
    odometry = robot.tell(state([0.01] * 3, 2.1))
    assert odometry.pose.pose.orientation.z < 0.0


def test_of_four_wheels_one_may_be_missing_and_come_back(tester):
    """Straight ahead all mecanum wheels turn alike; one that returns counts from there on."""
    robot = Robot(tester, **PATIENT, **MECANUM)
    names = ['a', 'b', 'c', 'd']
    robot.tell(state([0.0] * 4, 1.0, names))
    robot.tell(state([0.2] * 3, 1.1, ['d', 'a', 'c']))
    assert 'goes on without b' in robot.node.plain.diagnose().message
    robot.tell(state([0.4, 77.0, 0.4, 0.4], 1.2, names))
    last = robot.tell(state([0.6, 77.2, 0.6, 0.6], 1.3, names))
    assert last.pose.pose.position.x == pytest.approx(0.6 * RADIUS)
    assert last.pose.pose.position.y == pytest.approx(0.0, abs=1e-12)
    assert robot.node.plain.diagnose().values['wheels left out'] == 'none'


def test_set_odometry_goes_on_from_there(tester):
    robot = Robot(tester, **PATIENT)
    robot.tell(state([0.0] * 3, 1.0))
    request = SetMap.Request()
    request.initial_pose.pose.pose.position.x = 7.0
    assert tester.ask(SetMap, 'omni_kinematics/set_odometry', request).success
    odometry = robot.tell(state([0.0] * 3, 1.1))
    assert odometry.pose.pose.position.x == 7.0
    request.initial_pose.pose.covariance[0] = -1.0
    assert not tester.ask(SetMap, 'omni_kinematics/set_odometry', request).success
    request.initial_pose.pose.pose.position.x = nan
    assert not tester.ask(SetMap, 'omni_kinematics/set_odometry', request).success
    assert robot.tell(state([0.0] * 3, 1.2)).pose.pose.position.x == 7.0


def test_a_base_that_cannot_be_is_refused(tester):
    with pytest.raises(ConfigurationError, match='2 wheel_radii, 3 joint_names: give all six'):
        tester.start(OmniKinematics, wheel_radii=[0.05, 0.05])
    with pytest.raises(StartError):
        tester.start(OmniKinematics, wheel_directions=[0.0] * 3)
    node = tester.start(OmniKinematics, activate=False, wheel_directions=[0.0] * 3)
    with pytest.raises(GeometryError, match='no wheel turns when the base moves along'):
        OmniWheels.of(node.parameters)
