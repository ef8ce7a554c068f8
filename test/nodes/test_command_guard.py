"""When driven wheels stand, in a graph of this process: the clock is the test's."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

from agv_motion.activity import HeldBy
from agv_motion.nodes.command_guard import CommandGuard
from agv_motion.nodes.input_parameters import DrivenParameters
from agv_motion.planar import REST, Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import LATCHED, SENSOR

SECOND = 1_000_000_000
START = 1000 * SECOND
FAST = Twist(0.5, 0.0, 0.1)


@dataclass(frozen=True)
class CartParameters(DrivenParameters):
    """Of the node below."""

    report_after: float = 0.2
    stop_after: float = 0.4


class Cart(PlainNode):
    """Wheels that note what they are told, and when [s]."""

    name = 'cart'
    takes = CartParameters

    def __init__(self, port, parameters):
        super().__init__(port, parameters)
        self.standing, self.unwinding = False, False
        self.told = []
        self.guard = CommandGuard(port, parameters, 'wheels/state', self)
        port.listen(JointState, 'wheels/state', self.on_state, SENSOR)
        port.watch_inputs(parameters.stop_after, self.guard.judge)

    def on_state(self, message):
        if self.guard.state.is_news(message.header.stamp):
            self.guard.state.note()

    def note(self, what):
        self.told.append((round(self.port.seconds() - START / SECOND, 3), what))

    def aim_at_rest(self):
        self.note('aim at rest')

    def drive(self, twist):
        self.note('hold' if self.guard.reason else twist)

    def stand(self):
        self.note('stand')

    def start_anew(self):
        self.note('start anew')


class Trial:
    """A cart, and messages to it."""

    def __init__(self, **given):
        self.graph = InProcessGraph(lambda *_: None, START)
        self.node = InProcessNode(self.graph, Cart, given)
        self.cart = self.node.plain
        self.graph.start()

    def twist(self, seconds, twist=FAST, *, stamp=None, frame=''):
        message = TwistStamped()
        message.header.frame_id = frame
        message.header.stamp = stamp_of(self._at(seconds if stamp is None else stamp))
        message.twist.linear.x, _, message.twist.angular.z = twist
        self._feed('/cmd_vel', seconds, message)

    def state(self, seconds):
        message = JointState()
        message.header.stamp = stamp_of(self._at(seconds))
        self._feed('/wheels/state', seconds, message)

    def arbitrate(self):
        """Let there be somebody who publishes `standstill`."""
        self.node.port.publisher(Bool, 'standstill', LATCHED)

    def stop_message(self, seconds, speed=0.0):
        message = TwistStamped()
        message.twist.linear.x = speed
        self._feed('/cmd_vel/stop', seconds, message)

    def standstill(self, seconds, *, holds):
        self._feed('/standstill', seconds, Bool(data=holds))

    def pass_until(self, seconds):
        self.graph.run(self._at(seconds))

    def stop(self, *, data):
        return self.node.port.services['~/stop'][1](SetBool.Request(data=data))

    def clear(self):
        told = list(self.cart.told)
        self.cart.told.clear()
        return told

    def _at(self, seconds):
        return START + round(seconds * SECOND)

    def _feed(self, topic, seconds, message):
        self.graph.feed(topic, self._at(seconds), codec(type(message)).encode(message))


def test_news_is_driven_and_a_repeat_is_not():
    trial = Trial()
    trial.twist(0.05)
    trial.twist(0.06, stamp=0.05)
    assert trial.clear() == [(0.05, FAST)]


def test_a_zero_is_obeyed_however_old_it_is_but_drives_nothing():
    trial = Trial()
    trial.twist(0.05, REST, stamp=-999.0)
    assert trial.clear() == [(0.05, 'aim at rest')]
    assert any('ago, limit 1 s' in text for text in trial.graph.complaints)


def test_a_zero_in_another_frame_is_obeyed_and_refused():
    trial = Trial()
    trial.twist(0.05, REST, frame='map')
    assert trial.clear() == [(0.05, 'aim at rest')]
    assert any("frame 'map': expected 'base_link'" in text for text in trial.graph.complaints)


def test_silence_stops_within_its_limit_and_a_period_of_the_watch():
    trial = Trial()
    trial.twist(0.05)
    trial.pass_until(0.449)
    assert trial.clear() == [(0.05, FAST)]
    trial.pass_until(0.65)
    assert trial.clear() == [(0.5, 'stand'), (0.6, 'stand')]


@pytest.mark.parametrize('given', ['standing', 'unwinding'])
def test_silence_where_nobody_needs_to_command(given):
    trial = Trial()
    trial.twist(0.05)
    setattr(trial.cart, given, True)
    trial.clear()
    trial.pass_until(0.65)
    assert bool(trial.clear()) is (given == 'standing')  # zeros go on, again and again
    told = any('no cmd_vel for' in text for text in trial.graph.complaints)
    assert told is (given == 'unwinding')


def test_encoders_that_have_spoken_and_fall_silent_hold_the_wheels():
    trial = Trial()
    trial.state(0.05)
    for i in range(1, 10):
        trial.twist(0.1 * i + 0.01)
    told = trial.clear()
    assert (0.5, 'stand') in told
    assert told[-1][1] == 'stand' or told[-1][1] == 'hold'
    assert trial.cart.guard.reason == 'wheels/state is lost'
    trial.state(0.95)
    trial.pass_until(1.0)
    assert trial.cart.guard.reason == ''


def test_encoders_that_never_spoke_hold_nothing():
    trial = Trial()
    for i in range(1, 10):
        trial.twist(0.1 * i - 0.05)
    assert {what for _, what in trial.clear()} == {FAST}


def test_a_stop_holds_until_it_is_released():
    trial = Trial()
    assert trial.stop(data=True) == 'stopped; call again with data: false to drive on'
    trial.twist(0.05)
    assert trial.clear() == [(0.0, 'stand'), (0.05, 'hold')]
    assert trial.cart.guard.reason == 'by request'
    assert trial.stop(data=False) == 'free to drive'
    trial.twist(0.06)
    assert trial.clear() == [(0.05, 'start anew'), (0.06, FAST)]


def test_a_standstill_stands_at_once_and_holds_until_the_arbiter_lets_go():
    trial = Trial()
    trial.twist(0.05)
    trial.standstill(0.06, holds=True)
    trial.twist(0.07)
    assert trial.clear() == [(0.05, FAST), (0.06, 'stand'), (0.07, 'hold')]
    assert trial.cart.guard.reason.startswith('standstill: STOP holds')
    trial.standstill(0.08, holds=False)
    trial.twist(0.09)
    assert trial.clear() == [(0.08, 'start anew'), (0.09, FAST)]
    assert trial.cart.guard.reason == ''


def test_a_standstill_that_never_held_changes_nothing():
    trial = Trial()
    trial.standstill(0.05, holds=False)
    trial.twist(0.06)
    assert trial.clear() == [(0.06, FAST)]


def test_a_request_and_a_standstill_are_released_each_by_itself():
    trial = Trial()
    trial.arbitrate()
    trial.stop(data=True)
    trial.standstill(0.01, holds=True)
    assert trial.stop(data=False).startswith('still held: standstill')
    trial.twist(0.02)
    assert trial.clear()[-1] == (0.02, 'hold')
    trial.stop(data=True)
    trial.standstill(0.03, holds=False)
    trial.twist(0.04)
    assert trial.clear()[-1] == (0.04, 'hold')
    assert trial.cart.guard.reason == 'by request'


@pytest.mark.parametrize('speed', [0.0, nan])
def test_stop_need_not_wait_for_the_arbiter_which_releases_it(speed):
    trial = Trial()
    trial.arbitrate()
    trial.twist(0.05)
    trial.stop_message(0.06, speed)
    trial.twist(0.07)
    assert trial.clear() == [(0.05, FAST), (0.06, 'stand'), (0.07, 'hold')]
    trial.stop(data=False)
    trial.twist(0.08)
    assert trial.clear()[-1] == (0.08, 'hold')
    trial.standstill(0.09, holds=False)
    trial.twist(0.10)
    assert trial.clear()[-1] == (0.10, FAST)


def test_without_an_arbiter_the_request_releases_a_stop():
    trial = Trial()
    trial.stop_message(0.01)
    trial.twist(0.02)
    assert trial.clear()[-1] == (0.02, 'hold')
    assert trial.stop(data=False) == 'free to drive'
    trial.twist(0.03)
    assert trial.clear()[-1] == (0.03, FAST)


def test_a_reason_of_the_node_holds_as_a_request_does():
    trial = Trial()
    trial.cart.guard.stop_for('turrets fight', HeldBy.FIGHT)
    trial.twist(0.05)
    assert trial.clear() == [(0.0, 'stand'), (0.05, 'hold')]
    assert trial.cart.guard.reason == 'turrets fight'


def test_no_twist_counts_while_the_clock_has_a_fault():
    trial = Trial()
    trial.node.port.clock.fault = 'the clock leapt'
    trial.twist(0.05)
    assert trial.clear() == []
    trial.pass_until(0.1)
    assert trial.clear() == [(0.1, 'stand')]


def test_a_twist_without_a_stamp_is_news():
    trial = Trial(stamped=False)
    message = TwistMessage()
    message.linear.x, message.angular.z = FAST.vx, FAST.wz
    trial._feed('/cmd_vel', 0.05, message)  # noqa: SLF001 - of this file
    assert trial.clear() == [(0.05, FAST)]
