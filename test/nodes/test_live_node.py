"""`LiveNode` over a real graph: defects in callbacks, and refusals without end."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistStamped
from rcl_interfaces.msg import Log
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool

from agv_motion.nodes.command_guard import CommandGuard
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros.diagnosis import ERROR
from agv_motion.ros.qos import SENSOR
from agv_motion.ros.run import start

BASE = {'track': 0.4, 'wheel_radii': [0.05, 0.04], 'max_wheel_speed': 2.0, 'stop_after': 3000.0,
        'report_after': 3000.0}  # fmt: skip


class Robot:
    """Wheels that drive, in a node one of whose callbacks has a defect."""

    def __init__(self, tester):
        self.tester = tester
        self.commands = tester.listen(JointState, 'wheels/command')
        self.diagnostics = tester.listen(DiagnosticArray, '/diagnostics', 10)
        self.log = tester.listen(Log, '/rosout', 100)
        self.node = tester.start(DifferentialKinematics, **BASE)
        self.cmd_vel = tester.publisher(TwistStamped, 'cmd_vel')
        self.encoders = tester.publisher(JointState, 'wheels/state', SENSOR)

    def drive(self):
        """Send a twist until the wheels turn."""
        message = TwistStamped()
        message.twist.linear.x = 0.5
        self.commands.clear()

        def turning():
            message.header.stamp = self.node.get_clock().now().to_msg()
            self.cmd_vel.publish(message)
            self.tester.graph.spin_for(0.05)
            return any(any(command.velocity) for command in self.commands)

        self.tester.graph.spin_until(turning)
        self.commands.clear()

    def stands_and_says_so(self, *words):
        self.tester.wait(self.commands, lambda m: list(m.velocity) == [0.0, 0.0])
        log = self.tester.wait(self.log, lambda m: m.level == Log.FATAL)
        report = self.tester.wait(
            self.diagnostics, lambda m: m.status[0].message.startswith('stopped by a defect')
        )
        assert report.status[0].level == ERROR
        for word in words:
            assert word in log.msg
            assert word in report.status[0].message
        assert 'Traceback' in log.msg
        assert not any(self.commands[-1].velocity)


def fail(*_, **__):
    """Have a defect."""
    return 1 // 0


@pytest.fixture
def robot(tester):
    """Return wheels that turn."""
    made = Robot(tester)
    made.drive()
    return made


def test_a_defect_at_a_message_leaves_an_explicit_zero_and_the_node_can_go_on(robot):
    robot.node.plain.carry = fail
    message = JointState(name=['left_wheel', 'right_wheel'], position=[0.0, 0.0])
    message.header.stamp = robot.node.get_clock().now().to_msg()
    robot.encoders.publish(message)
    robot.stands_and_says_so('wheels/state', 'ZeroDivisionError')
    del robot.node.plain.carry
    robot.node.trigger_activate()
    robot.drive()


def test_a_defect_at_a_timer(robot):
    robot.node.plain.commands._rates.get_subscription_count = fail  # noqa: SLF001 - asked by its watch
    robot.stands_and_says_so('a timer', 'ZeroDivisionError')


def test_a_defect_in_the_diagnostics(robot):
    robot.node.plain.diagnose = fail
    robot.stands_and_says_so('the diagnostics', 'ZeroDivisionError')


def test_a_defect_at_a_service_is_answered(robot, monkeypatch):
    monkeypatch.setattr(CommandGuard, '_on_stop', fail)
    robot.node.trigger_deactivate()
    robot.node.trigger_cleanup()
    start(robot.node)
    answer = robot.tester.ask(SetBool, 'differential_kinematics/stop', SetBool.Request())
    assert not answer.success
    assert 'ZeroDivisionError' in answer.message


def test_a_flood_of_foreign_joints_fills_no_log(robot):
    """Names that differ at every message, each 10 kB: a handful of short lines."""
    robot.log.clear()
    before = robot.node.port.complaints.count
    numbers = iter(range(10**6))

    def flooded():
        number = next(numbers)
        names = [f'{chr(97 + number % 26)}{number}_' + 'x' * 200 for _ in range(50)]
        robot.encoders.publish(JointState(name=names, position=[0.0] * 50))
        robot.tester.graph.spin_for(0.0)
        return robot.node.port.complaints.count >= before + 300

    robot.tester.graph.spin_until(flooded)
    robot.tester.graph.spin_until(lambda: robot.log)
    lines = [line.msg for line in robot.log if line.msg.startswith('refused: wheels/state')]
    assert 1 <= len(lines) <= 40
    assert max(map(len, lines)) < 700
    assert len(robot.node.complaint) < 700
