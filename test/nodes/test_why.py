"""Node `why` beside a tree that says how it is: what it tells, when, and to whom it listens."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from agv_motion.nodes.why import Why
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode

SECOND = 1_000_000_000
NOON = 1434369600


def report(name, level, message, **values):
    pairs = [KeyValue(key=k, value=v) for k, v in values.items()]
    return DiagnosticStatus(level=bytes([level]), name=name, message=message, values=pairs)


ZERO = {
    'held by': 'nobody',
    'vx [m/s]': '0',
    'vy [m/s]': '0',
    'wz [rad/s]': '0',
    'cmd_vel age [s]': '0.1',
}


class Listener:
    """The node in a graph of its own, and what it told when [s]."""

    def __init__(self):
        self.told = []
        self.graph = InProcessGraph(self.record, NOON * SECOND)
        InProcessNode(self.graph, Why, {}, namespace='/oak')
        self.graph.start()

    def record(self, publisher, stamp, data):
        assert publisher.topic == '/oak/why'
        self.told.append((stamp / SECOND - NOON, codec(publisher.kind).decode(data)))

    def feed(self, seconds, topic, message):
        stamp = int((NOON + seconds) * SECOND)
        self.graph.feed(topic, stamp, codec(type(message)).encode(message))

    def rests(self, seconds, name='oak'):
        reports = [
            report(f'/{name}/wheel_kinematics', 0, 'driving', **ZERO),
            report(f'/{name}/motion_generator', 1, 'paused', activity='paused', because='person'),
        ]
        self.feed(seconds, '/diagnostics', DiagnosticArray(status=reports))

    def heads(self):
        return [message.status[0].message for _, message in self.told]


@pytest.fixture
def why():
    return Listener()


def test_the_headline_comes_first_and_then_each_link(why):
    why.rests(0.1)
    why.graph.run((NOON + 1) * SECOND)
    message = why.told[-1][1]
    head = message.status[0]
    assert head.name == 'headline'
    assert head.message == (
        'no encoders are heard: cmd_vel is zero: paused: whoever asked for it can end it, '
        'on the page'
    )
    assert head.level == DiagnosticStatus.WARN
    values = {pair.key: pair.value for pair in head.values}
    assert values['cause'] == 'decision'
    assert values['remedy'] == 'whoever asked for it can end it, on the page'
    names = [status.name for status in message.status[1:]]
    assert names == ['wheels', 'cmd_vel', 'decision', 'pose', 'sap flow']
    assert message.header.stamp.sec == NOON


def test_it_is_told_once_a_second_and_when_the_headline_changes(why):
    for tenth in range(50):
        why.rests(0.1 * tenth)
    assert 4 <= len(why.told) <= 7
    before = len(why.told)
    drives = report('/oak/motion_generator', 0, 'walking', activity='walking', because='goal')
    why.feed(5.0, '/diagnostics', DiagnosticArray(status=[drives]))
    why.graph.run(int((NOON + 5.25) * SECOND))
    assert len(why.told) > before
    assert why.heads()[-1] == 'no encoders are heard: cmd_vel is zero: walking'


def test_of_another_robot_and_of_nothing_nothing_is_told(why):
    why.rests(0.5, name='ash')
    why.graph.run((NOON + 3) * SECOND)
    assert why.told == []


def test_silence_is_told_though_nothing_comes_any_more(why):
    why.rests(0.1)
    why.graph.run((NOON + 10) * SECOND)
    assert 'wheel_kinematics is silent' in why.heads()[-1]
    assert why.told[-1][1].status[0].level == DiagnosticStatus.ERROR


def test_a_stop_of_the_arbiter_is_told_at_once(why):
    why.rests(0.1)
    why.graph.run((NOON + 1) * SECOND)
    values = {'driver': 'stop', 'stop': 'by maria, since 12:00:01'}
    stop = report('/oak/arbiter', 2, 'STOP: by maria, since 12:00:01', **values)
    why.feed(1.05, '/oak/driver', stop)
    seconds, message = why.told[-1]
    assert seconds == pytest.approx(1.05)
    assert 'STOP holds: by maria' in message.status[0].message
