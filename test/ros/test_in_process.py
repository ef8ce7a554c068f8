"""Nodes in a world of their own: topics, timers, parameters, refusals, order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PointStamped
from std_msgs.msg import Float64

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.parameters import Spec, check
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process import add
from agv_motion.ros.node import ManagedNode
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.world import World

SECOND = 1_000_000_000
START = 1000 * SECOND
FLOAT = codec(Float64)


@dataclass(frozen=True)
class EchoParameters:
    """Of the node below."""

    gain: Annotated[float, Spec('times', '1', (0.0, 10.0))] = 2.0

    def __post_init__(self):
        """Check every row."""
        check(self)


class Echo(ManagedNode):
    """Says `gain` times what it hears; every second, what time it is; zero at its end."""

    def __init__(self, **kwargs):
        super().__init__('echo', EchoParameters, **kwargs)

    def open(self):
        self.out = self.publisher(Float64, 'out', COMMAND)
        self.ticks = self.publisher(PointStamped, '~/tick', COMMAND)
        self.listen(Float64, 'in', self.hear, COMMAND)
        self.every(1.0, self.tick)

    def hear(self, message):
        if message.data < 0.0:
            msg = f'{message.data} is negative'
            raise SignalError(msg)
        self.out.publish(Float64(data=self.parameters.gain * message.data))

    def tick(self):
        message = PointStamped()
        self.stamp(message)
        self.ticks.publish(message)

    def halt(self):
        self.out.publish(Float64(data=0.0))


class Late(Echo):
    """Hears what Echo says."""

    def open(self):
        self.heard = []
        self.listen(Float64, 'out', lambda m: self.heard.append(m.data), COMMAND)


class Diary:
    """A world and everything that was said in it."""

    def __init__(self):
        self.said = []
        self.world = World(self.record, START)

    def record(self, publisher, stamp, data):
        value = codec(publisher.kind).decode(data)
        content = value.data if publisher.kind is Float64 else value.header.stamp.sec
        self.said.append(((stamp - START) / SECOND, publisher.topic, content))

    def feed(self, topic, seconds, value):
        data = FLOAT.encode(Float64(data=value))
        self.world.feed(topic, START + int(seconds * SECOND), data)


@pytest.fixture
def diary():
    return Diary()


def test_timers_and_messages_in_the_order_of_time(diary):
    add(diary.world, Echo, {}, {})
    diary.world.start()
    diary.feed('/in', 0.5, 1.0)
    diary.feed('/in', 2.5, 3.0)
    diary.world.run(START + 3 * SECOND + 1)
    diary.world.stop()
    assert diary.said == [
        (0.5, '/out', 2.0),
        (1.0, '/echo/tick', 1001),
        (2.0, '/echo/tick', 1002),
        (2.5, '/out', 6.0),
        (3.0, '/echo/tick', 1003),
        (3.0, '/out', 0.0),
    ]


def test_nodes_hear_each_other_but_nobody_hears_before_all_are_active(diary):
    add(diary.world, Echo, {}, {})
    late = add(diary.world, Late, {}, {})
    assert diary.world.inputs() == {'/in'}
    diary.world.start()
    diary.feed('/in', 0.1, 1.0)
    assert late.heard == []  # what nodes say is heard after all that was recorded at its time
    diary.world.run(START + SECOND // 2)
    assert late.heard == [2.0]


def test_parameters_and_remaps_are_as_live(diary):
    add(diary.world, Echo, {'gain': 3.0, 'use_sim_time': True}, {'/in': '/other', '/out': '/x'})
    assert diary.world.inputs() == {'/other'}
    diary.world.start()
    diary.feed('/other', 0.1, 1.0)
    assert diary.said == [(0.1, '/x', 3.0)]


@pytest.mark.parametrize(
    ('parameters', 'message'),
    [
        ({'gain': 11.0}, r'gain = 11\.0: must lie in \[0, 10\]'),
        ({'gain': 1}, 'gain = 1: expected float'),
        ({'gian': 1.0}, 'no parameter gian'),
    ],
)
def test_wrong_parameters_are_refused(diary, parameters, message):
    with pytest.raises(ConfigurationError, match=message):
        add(diary.world, Echo, parameters, {})


def test_what_is_refused_is_counted_and_the_node_lives_on(diary):
    add(diary.world, Echo, {}, {})
    diary.world.start()
    diary.feed('/in', 0.1, -1.0)
    diary.feed('/in', 0.2, -1.0)
    diary.feed('/in', 0.3, 1.0)
    assert diary.world.complaints == {'echo: refused: in: -1.0 is negative': 2}
    assert diary.said == [(0.3, '/out', 2.0)]


def test_what_was_looked_at_together_is_heard_one_by_one(diary):
    shown = []

    def prepare(messages, stamps):
        shown.append(len(messages))
        return [Float64(data=10.0 + FLOAT.decode(data).data) for data in messages]

    echo = add(diary.world, Echo, {}, {})
    echo.listener('in').prepare = prepare
    diary.world.start()
    messages = [FLOAT.encode(Float64(data=float(i))) for i in range(2)]
    diary.world.look_ahead('/in', messages, [START, START + SECOND])
    diary.feed('/in', 0.1, 0.0)
    diary.feed('/in', 0.2, 1.0)
    diary.feed('/in', 0.3, 2.0)
    assert shown == [2]
    assert diary.said == [(0.1, '/out', 20.0), (0.2, '/out', 22.0), (0.3, '/out', 4.0)]


class Broken(Echo):
    """Cannot be opened."""

    def open(self):
        msg = 'no such zone'
        raise ConfigurationError(msg)


def test_a_node_that_cannot_start_says_why(diary):
    with pytest.raises(ConfigurationError, match='cannot configure: no such zone'):
        add(diary.world, Broken, {}, {})


def test_a_publisher_knows_who_listens(diary):
    echo = add(diary.world, Echo, {}, {})
    assert echo.out.get_subscription_count() == 0
    diary.world.recorded = {'/out'}
    add(diary.world, Late, {}, {})
    assert echo.out.get_subscription_count() == 2
