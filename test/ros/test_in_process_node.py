"""Nodes in a graph of their own: topics, timers, parameters, refusals, order."""

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
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.port import Ahead
from agv_motion.ros.qos import COMMAND

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


class Echo(PlainNode):
    """Says `gain` times what it hears; every second, what time it is; zero at its end."""

    name = 'echo'
    takes = EchoParameters

    def __init__(self, port, parameters):
        super().__init__(port, parameters)
        self.shown = []
        self.out = port.publisher(Float64, 'out', COMMAND)
        self.ticks = port.publisher(PointStamped, '~/tick', COMMAND)
        port.listen_ahead(Float64, 'in', self.hear, Ahead(self.prepare, self.hear), COMMAND)
        port.every(1.0, self.tick)

    def prepare(self, messages, _):
        self.shown.append(len(messages))
        return [Float64(data=10.0 + FLOAT.decode(data).data) for data in messages]

    def hear(self, message):
        if message.data < 0.0:
            msg = f'{message.data} is negative'
            raise SignalError(msg)
        self.out.publish(Float64(data=self.parameters.gain * message.data))

    def tick(self):
        message = PointStamped()
        self.port.stamp(message)
        self.ticks.publish(message)

    def halt(self):
        self.out.publish(Float64(data=0.0))


class Late(PlainNode):
    """Hears what Echo says."""

    name = 'late'
    takes = EchoParameters

    def __init__(self, port, parameters):
        super().__init__(port, parameters)
        self.heard = []
        port.listen(Float64, 'out', lambda m: self.heard.append(m.data), COMMAND)


class Diary:
    """A graph and everything that was said in it."""

    def __init__(self):
        self.said = []
        self.graph = InProcessGraph(self.record, START)

    def record(self, publisher, stamp, data):
        value = codec(publisher.kind).decode(data)
        content = value.data if publisher.kind is Float64 else value.header.stamp.sec
        self.said.append(((stamp - START) / SECOND, publisher.topic, content))

    def feed(self, topic, seconds, value):
        data = FLOAT.encode(Float64(data=value))
        self.graph.feed(topic, START + int(seconds * SECOND), data)


@pytest.fixture
def diary():
    return Diary()


def test_timers_and_messages_in_the_order_of_time(diary):
    InProcessNode(diary.graph, Echo, {})
    diary.graph.start()
    diary.feed('/in', 0.5, 1.0)
    diary.feed('/in', 2.5, 3.0)
    diary.graph.run(START + 3 * SECOND + 1)
    diary.graph.stop()
    assert diary.said == [
        (0.5, '/out', 2.0),
        (1.0, '/echo/tick', 1001),
        (2.0, '/echo/tick', 1002),
        (2.5, '/out', 6.0),
        (3.0, '/echo/tick', 1003),
        (3.0, '/out', 0.0),
    ]


def test_nodes_hear_each_other_but_nobody_hears_before_all_are_active(diary):
    InProcessNode(diary.graph, Echo, {})
    late = InProcessNode(diary.graph, Late, {})
    assert diary.graph.inputs() == {'/in'}
    diary.graph.start()
    diary.feed('/in', 0.1, 1.0)
    assert late.plain.heard == []  # what nodes say is heard after all that was recorded at its time
    diary.graph.run(START + SECOND // 2)
    assert late.plain.heard == [2.0]


def test_parameters_and_remaps_are_as_live(diary):
    InProcessNode(
        diary.graph, Echo, {'gain': 3.0, 'use_sim_time': True}, {'/in': '/other', '/out': '/x'}
    )
    assert diary.graph.inputs() == {'/other'}
    diary.graph.start()
    diary.feed('/other', 0.1, 1.0)
    assert diary.said == [(0.1, '/x', 3.0)]


@pytest.mark.parametrize(
    ('parameters', 'message'),
    [
        ({'gain': 11.0}, r'gain = 11\.0: must lie in \[0, 10\]'),
        ({'gain': 1}, r'gain = 1: expected a decimal number such as 1.0: write 1\.0'),
        ({'gian': 1.0}, 'no parameter gian'),
    ],
)
def test_wrong_parameters_are_refused(diary, parameters, message):
    with pytest.raises(ConfigurationError, match=message):
        InProcessNode(diary.graph, Echo, parameters)


def test_what_is_refused_is_counted_and_the_node_lives_on(diary):
    InProcessNode(diary.graph, Echo, {})
    diary.graph.start()
    diary.feed('/in', 0.1, -1.0)
    diary.feed('/in', 0.2, -1.0)
    diary.feed('/in', 0.3, 1.0)
    assert diary.graph.complaints == {'echo: refused: in: -1.0 is negative': 2}
    assert diary.said == [(0.3, '/out', 2.0)]


def test_what_was_looked_at_together_is_heard_one_by_one(diary):
    echo = InProcessNode(diary.graph, Echo, {})
    diary.graph.start()
    messages = [FLOAT.encode(Float64(data=float(i))) for i in range(2)]
    diary.graph.look_ahead('/in', messages, [START, START + SECOND])
    diary.feed('/in', 0.1, 0.0)
    diary.feed('/in', 0.2, 1.0)
    diary.feed('/in', 0.3, 2.0)
    assert echo.plain.shown == [2]
    assert diary.said == [(0.1, '/out', 20.0), (0.2, '/out', 22.0), (0.3, '/out', 4.0)]


class Broken(Echo):
    """Cannot be opened."""

    def __init__(self, port, parameters):
        super().__init__(port, parameters)
        msg = 'no such zone'
        raise ConfigurationError(msg)


def test_a_node_that_cannot_start_says_why(diary):
    with pytest.raises(ConfigurationError, match='cannot configure: no such zone'):
        InProcessNode(diary.graph, Broken, {})


def test_a_publisher_knows_who_listens(diary):
    echo = InProcessNode(diary.graph, Echo, {})
    assert echo.plain.out.get_subscription_count() == 0
    diary.graph.recorded = {'/out'}
    InProcessNode(diary.graph, Late, {})
    assert echo.plain.out.get_subscription_count() == 2
