"""The arbiter before each kinematics, in a graph of this process: how soon the wheels stand."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool

from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
START = 1000 * SECOND
GENTLE = {'max_wheel_acceleration': 0.2, 'max_wheel_deceleration': 0.2}
ROBOTS = {
    'tree': (WheelKinematics, 'turrets', {}, 0.03),
    'differential': (DifferentialKinematics, 'wheels', GENTLE, 0.3),
    'omni': (OmniKinematics, 'wheels', GENTLE, 0.3),
}
"""kinematics, the prefix of its topics, parameters, and a speed that takes a while [m/s]"""


class Robot:
    """An arbiter and kinematics, and what the wheels were commanded."""

    def __init__(self, kind):
        kinematics, prefix, given, self.speed = ROBOTS[kind]
        self.command = f'/{prefix}/command'
        self.rates, self.now = [], 0.0
        self.graph = InProcessGraph(self._record, START)
        self.arbiter = InProcessNode(self.graph, ArbiterNode, {})
        self.kinematics = InProcessNode(self.graph, kinematics, given)
        self.graph.start()

    def _record(self, publisher, stamp, data):
        if publisher.topic == self.command:
            rates = list(codec(JointState).decode(data).velocity)
            self.rates.append(((stamp - START) / SECOND, any(rates)))

    def keep_saying(self, source, seconds, speed=None):
        end = self.now + seconds
        while self.now < end - 1e-9:
            self.say(source, speed)
            self.until(self.now + 0.05)

    def say(self, source, speed=None):
        message = TwistStamped()
        message.header.stamp = stamp_of(START + round(self.now * SECOND))
        message.twist.linear.x = self.speed if speed is None else speed
        data = codec(TwistStamped).encode(message)
        self.graph.feed(f'/cmd_vel/{source}', START + round(self.now * SECOND), data)
        self.until(self.now)

    def until(self, seconds):
        self.now = round(seconds, 6)
        # what was said is heard when the next moment begins
        self.graph.run(START + round(self.now * SECOND) + 1)

    def release(self):
        self.arbiter.port.services['~/stop'][1](SetBool.Request(data=False))

    @property
    def stood_at(self):
        """When the wheels were commanded zero for good."""
        moved = [moment for moment, rolls in self.rates if rolls]
        return next(moment for moment, rolls in self.rates if not rolls and moment >= moved[-1])


@pytest.mark.parametrize('kind', ROBOTS)
def test_stop_is_a_zero_to_the_wheels_at_once_and_holds(kind):
    robot = Robot(kind)
    robot.keep_saying('agent', 2.0)
    assert robot.rates[-1][1]
    robot.say('stop')
    robot.keep_saying('agent', 1.0)
    assert robot.stood_at == pytest.approx(2.0, abs=1e-6)
    assert robot.kinematics.plain.diagnose().message.startswith('stopped: standstill')
    robot.release()
    robot.keep_saying('agent', 1.0)
    assert robot.rates[-1][1]


@pytest.mark.parametrize('kind', ROBOTS)
def test_a_dead_man_that_is_let_go_stops_the_wheels_within_half_a_second(kind):
    robot = Robot(kind)
    robot.keep_saying('manual', 2.0)
    robot.keep_saying('agent', 2.0)
    assert 2.2 < robot.stood_at <= 2.4
    robot.keep_saying('manual', 1.0)
    assert robot.rates[-1][1]


@pytest.mark.parametrize('kind', ROBOTS)
def test_a_zero_of_a_driver_brakes_by_the_ramp(kind):
    robot = Robot(kind)
    robot.keep_saying('agent', 2.0)
    robot.keep_saying('agent', 3.0, 0.0)
    assert 2.3 < robot.stood_at < 4.0


@pytest.mark.parametrize('kind', ROBOTS)
def test_without_an_arbiter_the_wheels_stop_by_the_silence_of_cmd_vel(kind):
    robot = Robot(kind)
    robot.keep_saying('agent', 2.0)
    given = robot.kinematics.plain.parameters
    robot.arbiter.port.active = False  # as if it were killed
    robot.until(2.0 + given.stop_after + 0.2)
    assert 2.0 + given.stop_after - 0.11 <= robot.stood_at <= 2.0 + given.stop_after + 0.1
