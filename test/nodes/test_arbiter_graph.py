"""The arbiter on a real graph: STOP over a restart, while it is inactive, and beside another."""

from __future__ import annotations

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import TwistStamped
from rclpy.qos import QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros.qos import LATCHED

GENTLE = {'max_wheel_acceleration': 1.0, 'max_wheel_deceleration': 1.0, 'stop_after': 30.0}
PATIENT = {'timeouts__agent': 30.0, 'timeouts__manual': 30.0}


class Crew:
    """Who asks the robot to move, and what its wheels are commanded."""

    def __init__(self, tester):
        self.tester, self.graph = tester, tester.graph
        self.commands = tester.listen(JointState, 'wheels/command')
        self.drivers = tester.listen(DiagnosticStatus, 'driver', LATCHED)
        self.stands = tester.listen(Bool, 'standstill', LATCHED)
        self.kinematics = tester.start(DifferentialKinematics, report_after=30.0, **GENTLE)

    def start(self, **given):
        return self.tester.start(ArbiterNode, **(PATIENT | given))

    def speak(self, source, speed=0.5):
        """Return what sends one twist."""
        publisher = self.tester.publisher(TwistStamped, f'cmd_vel/{source}')

        def say():
            message = TwistStamped()
            message.header.stamp = self.tester.node.get_clock().now().to_msg()
            message.twist.linear.x = speed
            publisher.publish(message)

        return say

    def drive(self, say):
        """Let somebody speak until the wheels turn."""
        self.commands.clear()
        self.graph.repeat(say, lambda: any(any(one.velocity) for one in self.commands), 0.05)

    def stood(self):
        """Wait until the wheels are told to stand."""
        self.tester.wait(self.stands, lambda message: message.data)
        self.graph.spin_until(lambda: self.commands and not any(self.commands[-1].velocity))

    def stays(self, say, times=5):
        """Let somebody speak in vain."""
        self.commands.clear()
        for _ in range(times):
            say()
            self.graph.spin_for(0.05)
        assert not any(any(one.velocity) for one in self.commands)

    def ask(self, service, *, data):
        return self.tester.ask(SetBool, f'arbiter/{service}', SetBool.Request(data=data))


@pytest.fixture
def crew(tester):
    return Crew(tester)


def test_stop_holds_over_a_restart_and_is_released_by_the_service_alone(crew, tmp_path):
    state = {'state_file': str(tmp_path / 'arbiter.json')}
    arbiter = crew.start(**state)
    agent, stop = crew.speak('agent'), crew.speak('stop', 0.0)
    crew.drive(agent)
    stop()
    crew.stood()
    crew.stays(agent)
    arbiter.trigger_shutdown()
    crew.stands.clear()
    asked = crew.tester.listen(SetBool.Event, 'arbiter/stop/_service_event', QoSProfile(depth=9))
    again = crew.start(**state)
    crew.stood()
    crew.graph.meet()
    crew.stays(agent)
    told = crew.tester.wait(crew.drivers, lambda one: 'agent waits' in one.message)
    assert 'STOP: asked for on cmd_vel/stop' in told.message
    assert crew.ask('stop', data=False).success
    crew.tester.wait(asked, lambda event: any(not one.data for one in event.request))
    crew.drive(agent)
    assert again.active


def test_what_came_on_stop_while_inactive_counts_at_the_activation(crew):
    arbiter = crew.start()
    agent, stop = crew.speak('agent'), crew.speak('stop', 0.0)
    crew.drive(agent)
    arbiter.trigger_deactivate()
    stop()
    crew.graph.spin_for(0.2)
    arbiter.trigger_activate()
    crew.stood()
    crew.stays(agent)


def test_a_lock_and_the_rank(crew):
    crew.start()
    agent, manual = crew.speak('agent'), crew.speak('manual', -0.5)
    crew.drive(agent)
    assert crew.ask('lock_manual', data=True).message == 'locked: nothing below it drives'
    crew.graph.spin_until(lambda: not any(crew.commands[-1].velocity))
    crew.stays(agent)
    crew.drive(manual)
    assert max(crew.commands[-1].velocity) < 0.0


def test_two_arbiters_stop_each_other(crew, capfd):
    one = crew.start()
    crew.drive(crew.speak('agent'))
    other = crew.tester.start(ArbiterNode, remap=['__node:=second'], **PATIENT)
    crew.graph.spin_until(lambda: not (one.active or other.active))
    crew.graph.spin_until(lambda: not any(crew.commands[-1].velocity))
    told = capfd.readouterr().err
    assert 'all publish /driver, which one node may alone' in told
    assert {'/arbiter', '/second'} <= set(told.replace(',', ' ').split())
