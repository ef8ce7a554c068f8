"""Node `differential_kinematics` over a real graph: wheels, odometry, and every way to stop."""

from __future__ import annotations

from itertools import pairwise
from math import nan, pi

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros.diagnosis import ERROR, OK, WARN
from agv_motion.ros.qos import SENSOR

BASE = {'track': 0.4, 'wheel_radii': [0.05, 0.04], 'max_wheel_speed': 2.0, 'max_age': 1e10}
UNRAMPED = {'max_wheel_acceleration': 0.0, 'max_wheel_deceleration': 0.0}
PATIENT = {'report_after': 20.0, 'stop_after': 30.0, 'max_age': 100.0}
NAMES = ['left_wheel', 'right_wheel']


def nanoseconds(header):
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


class Robot:
    """The node, its outputs, and hands to move its wheels."""

    def __init__(self, tester, **parameters):
        self.tester = tester
        self.commands = tester.listen(JointState, 'wheels/command')
        self.odometry = tester.listen(Odometry, 'odom', SENSOR)
        self.node = tester.start(DifferentialKinematics, **(BASE | parameters))
        self.cmd_vel = tester.publisher(TwistStamped, 'cmd_vel')
        self.encoders = tester.publisher(JointState, 'wheels/state', SENSOR)

    @staticmethod
    def twist(vx=0.0, vy=0.0, wz=0.0):
        message = TwistStamped()
        message.twist.linear.x, message.twist.linear.y, message.twist.angular.z = vx, vy, wz
        return message

    def send(self, **components):
        self.commands.clear()
        self.cmd_vel.publish(self.twist(**components))

    def drive(self, **components):
        """Return the command that answers a twist: the first that is stamped no sooner."""
        watch = self.node.plain.guard.command
        before = watch.newest
        self.send(**components)
        self.tester.graph.spin_until(lambda: watch.newest > before)
        return self.tester.wait(self.commands, lambda m: nanoseconds(m.header) >= watch.newest)

    def tell(self, angles, stamp, names=NAMES):
        message = JointState(name=names, position=angles)
        message.header.stamp.sec, rest = divmod(round(stamp * 1e9), 1_000_000_000)
        message.header.stamp.nanosec = rest
        self.odometry.clear()
        self.encoders.publish(message)


def test_a_twist_becomes_the_rates_of_both_wheels(tester):
    """0.5 m/s and 1 rad/s, track 0.4 m: 0.3 and 0.7 m/s; radii 5 and 4 cm: 6 and 17.5 rad/s."""
    command = Robot(tester, **UNRAMPED).drive(vx=0.5, wz=1.0)
    assert list(command.name) == NAMES
    assert list(command.velocity) == pytest.approx([6.0, 17.5])
    assert command.header.frame_id == 'base_link'


def test_beyond_the_limit_the_arc_stays(tester):
    command = Robot(tester, max_wheel_speed=0.35, **UNRAMPED).drive(vx=0.5, wz=1.0)
    assert list(command.velocity) == pytest.approx([3.0, 8.75])


def speeds(commands):
    """Return for each command its time [s] and the rim speeds [m/s]."""
    return [
        (nanoseconds(m.header) * 1e-9, (0.05 * m.velocity[0], 0.04 * m.velocity[1]))
        for m in commands
    ]


def test_a_step_of_the_twist_told_once_becomes_a_ramp_to_its_end_and_so_does_a_zero(tester):
    """Up with 0.5 m/s2 on one arc, down with 2 m/s2; `cmd_vel/limited` tells what is commanded."""
    robot = Robot(tester, max_wheel_acceleration=0.5, max_wheel_deceleration=2.0, **PATIENT)
    limited = tester.listen(TwistStamped, 'cmd_vel/limited')
    tester.graph.spin_until(lambda: robot.node.count_subscribers('cmd_vel/limited') > 0)
    robot.drive(vx=0.4, wz=0.5)
    tester.wait(robot.commands, lambda m: 0.04 * m.velocity[1] == pytest.approx(0.5))
    for steps, limit in ((speeds(robot.commands), 0.5), (None, 2.0)):
        if steps is None:
            robot.commands.clear()
            robot.cmd_vel.publish(robot.twist())
            tester.wait(robot.commands, lambda m: not any(m.velocity))
            steps = speeds(robot.commands)  # noqa: PLW2901 - of the second ramp
        assert len(steps) > 5
        for (before, first), (after, second) in pairwise(steps):
            assert abs(second[1] - first[1]) <= limit * (after - before) + 1e-6
            assert second[0] == pytest.approx(0.6 * second[1], abs=1e-9)
    tester.wait(limited, lambda m: m.twist.linear.x == pytest.approx(0.4))
    tester.wait(limited, lambda m: not m.twist.linear.x and m.header.stamp.sec > 0)
    by_time = {nanoseconds(m.header): m.twist for m in limited}
    for time, (left, right) in zip(
        map(nanoseconds, (m.header for m in robot.commands)),
        [pair for _, pair in speeds(robot.commands)],
        strict=True,
    ):
        if time in by_time:
            assert by_time[time].linear.x == pytest.approx(0.5 * (left + right))
            assert by_time[time].angular.z == pytest.approx((right - left) / 0.4)


def test_commands_that_come_often_do_not_add_up_to_more_than_the_limit(tester):
    """Each small step of a swift publisher is within the limit; all together must be too."""
    robot = Robot(tester, max_wheel_acceleration=0.5, max_wheel_deceleration=0.5, **PATIENT)
    robot.commands.clear()
    for k in range(1, 60):
        robot.cmd_vel.publish(robot.twist(vx=0.008 * k))
        tester.graph.executor.spin_once(timeout_sec=0.002)
    tester.wait(robot.commands, lambda m: 0.05 * m.velocity[0] == pytest.approx(0.472))
    for (before, (first, _)), (after, (second, _)) in pairwise(speeds(robot.commands)):
        assert second - first <= 0.5 * (after - before) + 1e-6


def test_a_stop_for_safety_is_at_once_and_the_next_start_is_ramped(tester):
    robot = Robot(tester, max_wheel_acceleration=0.5, max_wheel_deceleration=0.5, **PATIENT)
    robot.drive(vx=0.4)
    tester.wait(robot.commands, lambda m: 0.05 * m.velocity[0] == pytest.approx(0.4))
    robot.commands.clear()
    assert tester.ask(SetBool, 'differential_kinematics/stop', SetBool.Request(data=True)).success
    ((stopped, _),) = speeds([tester.wait(robot.commands)])
    assert list(robot.commands[0].velocity) == [0.0, 0.0]
    tester.ask(SetBool, 'differential_kinematics/stop', SetBool.Request(data=False))
    robot.commands.clear()
    robot.drive(vx=0.4)
    tester.wait(robot.commands, lambda m: 0.05 * m.velocity[0] == pytest.approx(0.4))
    period = 0.02  # the first step is that of a whole period, however soon it comes
    for time, (left, _) in speeds(robot.commands):
        assert left <= 0.5 * (time - stopped + period) + 1e-6


def test_a_robot_that_could_not_brake_is_refused(tester):
    with pytest.raises(ConfigurationError, match='brake at least as hard'):
        tester.start(DifferentialKinematics, max_wheel_deceleration=0.1)


def test_a_quarter_circle_is_told_exactly(tester):
    """0.5 m and 0.9 m about the left: the middle goes a quarter round 0.7 m."""
    robot = Robot(tester)
    robot.tell([0.0, 0.0], 1.0)
    tester.wait(robot.odometry)
    robot.tell([0.5 * pi / 2 / 0.05, 0.9 * pi / 2 / 0.04], 1.4)
    told = tester.wait(robot.odometry)
    assert told.pose.pose.position.x == pytest.approx(0.7)
    assert told.pose.pose.position.y == pytest.approx(0.7)
    assert told.twist.twist.angular.z == pytest.approx(pi / 2 / 0.4)
    assert told.pose.covariance[0] > 0.0
    assert told.pose.covariance[35] > 0.0


@pytest.mark.parametrize(
    ('twist', 'word'), [({'vx': nan}, 'must be finite'), ({'vy': 0.2}, 'cannot go sideways')]
)
def test_what_it_cannot_do_is_refused_and_is_no_sign_of_life(tester, twist, word):
    robot = Robot(tester, report_after=0.1, stop_after=0.2)
    assert any(robot.drive(vx=0.3).velocity)
    tester.graph.repeat(
        lambda: robot.cmd_vel.publish(robot.twist(**twist)),
        until=lambda: list(robot.commands[-1].velocity) == [0.0, 0.0],
    )
    assert word in robot.node.complaint


def test_silence_stop_and_the_end_are_explicit_zeros(tester):
    robot = Robot(tester, report_after=0.1, stop_after=0.2)
    assert any(robot.drive(vx=0.3).velocity)
    robot.commands.clear()
    tester.wait(robot.commands, lambda m: not any(m.velocity))
    ask = lambda data: tester.ask(  # noqa: E731
        SetBool, 'differential_kinematics/stop', SetBool.Request(data=data)
    )
    assert ask(data=True).success
    assert not any(robot.drive(vx=0.3).velocity)
    assert 'by request' in robot.node.plain.diagnose().message
    assert ask(data=False).success
    assert any(robot.drive(vx=0.3).velocity)
    robot.commands.clear()
    robot.node.trigger_deactivate()
    tester.graph.spin_until(lambda: robot.commands)
    assert list(robot.commands[-1].velocity) == [0.0, 0.0]


def test_silence_is_told_once_and_so_is_its_end(tester):
    robot = Robot(tester, report_after=0.1, stop_after=0.3)
    told = tester.logs()
    robot.drive(vx=0.3)
    tester.wait(told, lambda m: 'no cmd_vel' in m.msg and 'stopping' in m.msg)
    assert robot.node.plain.diagnose().level == WARN
    tester.graph.spin_for(0.5)
    tester.graph.repeat(
        lambda: robot.send(vx=0.3),
        until=lambda: any('cmd_vel is back after' in m.msg for m in told),
        every=0.05,
    )
    of_silence = [m for m in told if 'no cmd_vel' in m.msg or 'is back' in m.msg]
    assert sum('stopping' in m.msg for m in told) == 1
    tester.graph.spin_for(1.0)  # silent again, so soon that it is not worth a word
    assert [m for m in told if 'no cmd_vel' in m.msg or 'is back' in m.msg][-1] is of_silence[-1]


def test_a_robot_that_was_told_to_stand_misses_nobody(tester):
    robot = Robot(tester, report_after=0.5, stop_after=0.6)
    told = tester.logs()
    robot.drive(vx=0.3)
    robot.drive(vx=0.0)
    tester.graph.spin_for(1.0)
    assert not [m.msg for m in told if 'no cmd_vel' in m.msg]
    assert robot.node.plain.diagnose()[:2] == (OK, 'standing')


def test_encoders_that_fall_silent_stop_the_robot(tester):
    robot = Robot(tester, report_after=0.1, stop_after=0.2)
    robot.tell([0.0, 0.0], 1.0)
    tester.wait(robot.odometry)
    tester.graph.repeat(
        lambda: robot.cmd_vel.publish(robot.twist(vx=0.3)),
        until=lambda: 'wheels/state is lost' in robot.node.plain.diagnose().message,
    )
    assert list(robot.drive(vx=0.3).velocity) == [0.0, 0.0]


def test_one_encoder_alone_is_refused(tester):
    robot = Robot(tester)
    robot.tell([0.0], 1.0, names=['left_wheel'])
    tester.graph.spin_until(lambda: 'right_wheel is missing' in robot.node.complaint)


def test_set_odometry_goes_on_from_there(tester):
    robot = Robot(tester)
    robot.tell([0.0, 0.0], 1.0)
    tester.wait(robot.odometry)
    request = SetMap.Request()
    request.initial_pose.pose.pose.position.x = 5.0
    request.initial_pose.pose.pose.orientation.w = 1.0
    assert tester.ask(SetMap, 'differential_kinematics/set_odometry', request).success
    robot.tell([2.0, 2.5], 1.1)
    assert tester.wait(robot.odometry).pose.pose.position.x == pytest.approx(5.1)


def test_set_odometry_as_a_topic_does_the_same_and_refuses_another_frame(tester):
    robot = Robot(tester)
    robot.tell([0.0, 0.0], 1.0)
    tester.wait(robot.odometry)
    publisher = tester.publisher(PoseWithCovarianceStamped, 'set_odometry')
    message = PoseWithCovarianceStamped()
    message.pose.pose.position.x, message.pose.pose.orientation.w = 5.0, 1.0
    message.header.frame_id = 'map'
    publisher.publish(message)
    tester.graph.spin_until(lambda: "'map'" in robot.node.complaint)
    assert robot.odometry[-1].pose.pose.position.x == 0.0
    message.header.frame_id = 'odom'
    publisher.publish(message)
    stamps = iter(range(11, 1000))
    tester.graph.repeat(
        lambda: robot.tell([0.0, 0.0], 0.1 * next(stamps)),
        until=lambda: any(m.pose.pose.position.x == pytest.approx(5.0) for m in robot.odometry),
    )


@pytest.mark.parametrize(
    ('change', 'word'),
    [({'wheel_radii': [0.05]}, 'give two'), ({'joint_names': ['a', 'a']}, 'the same name')],
)
def test_a_base_that_cannot_be_is_refused(tester, change, word):
    with pytest.raises(ConfigurationError, match=word):
        tester.start(DifferentialKinematics, **(BASE | change))


def test_wheels_that_do_not_turn_though_told_to_are_blocked_until_a_zero_is_sent(tester):
    robot = Robot(tester, blocked__after=0.5, blocked__distance=0.001)
    stamps = iter(range(1, 10**6))

    def push(speed=0.5):
        robot.cmd_vel.publish(robot.twist(vx=speed))
        robot.tell([0.0, 0.0], 0.05 * next(stamps))

    def moving():
        return bool(robot.commands) and any(robot.commands[-1].velocity)

    tester.graph.repeat(push, moving, every=0.05)
    tester.graph.repeat(push, lambda: bool(robot.node.plain.why_stopped()), every=0.05)
    assert robot.node.plain.why_stopped().startswith('blocked: told to move by 0.')
    assert robot.node.plain.diagnose().level == ERROR
    robot.commands.clear()
    tester.graph.repeat(push, lambda: len(robot.commands) > 5, every=0.05)
    assert not any(any(command.velocity) for command in robot.commands)
    tester.graph.repeat(lambda: push(0.0), lambda: not robot.node.plain.why_stopped(), every=0.05)
    tester.graph.repeat(push, moving, every=0.05)


def test_wheels_that_turn_are_not_blocked(tester):
    robot = Robot(tester, blocked__after=0.5, blocked__distance=0.001)
    stamps, end = iter(range(1, 10**6)), robot.node.port.steady_seconds() + 1.5

    def roll():
        robot.cmd_vel.publish(robot.twist(vx=0.05))
        step = next(stamps)
        robot.tell([0.05 * step, 0.0625 * step], 0.05 * step)

    tester.graph.repeat(roll, lambda: robot.node.port.steady_seconds() > end, every=0.05)
    assert robot.node.plain.why_stopped() == ''


def test_activated_again_it_stands_until_a_twist_comes(tester):
    robot = Robot(tester)
    assert any(robot.drive(vx=0.5).velocity)
    robot.node.trigger_deactivate()
    tester.graph.spin_until(lambda: not any(robot.commands[-1].velocity))
    robot.commands.clear()
    robot.node.trigger_activate()
    tester.graph.spin_until(lambda: len(robot.commands) > 3)
    assert not any(any(command.velocity) for command in robot.commands)
    assert robot.node.plain.diagnose()[:2] == (OK, 'standing')
    assert any(robot.drive(vx=0.5).velocity)
