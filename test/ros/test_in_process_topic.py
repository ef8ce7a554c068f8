"""The two ends of a topic without middleware: bytes, rows as they are, and what was prepared."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Float64

from agv_motion.planar import Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.in_process_topic import SentRow
from agv_motion.ros.port import Ahead
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.twist_rows import TwistRows

SECOND = 1_000_000_000
ROW, STAMP = Twist(0.5, 0.0, -0.25), 7 * SECOND + 3


class Stage:
    """A graph that keeps what is said; one node speaks, another listens."""

    def __init__(self, *, takes_rows=True):
        self.said, self.heard = [], []
        self.graph = InProcessGraph(lambda _, __, data: self.said.append(data), STAMP)
        self.graph.takes_rows = takes_rows
        self.speaker, self.listener = (
            InProcessPort(self.graph, Place(name, '/', {}), str) for name in ('speaker', 'listener')
        )
        self.listener.active = True
        self.graph.start()

    def rows(self):
        return self.speaker.row_publisher(TwistRows('base_link'), 'cmd_vel', COMMAND)

    def hear_rows(self):
        def hear(*told):
            self.heard.append(told)

        self.listener.listen_to_rows(TwistRows('base_link'), 'cmd_vel', hear, COMMAND)

    def hear_messages(self):
        self.listener.listen(TwistStamped, 'cmd_vel', self.heard.append, COMMAND)


def test_a_row_goes_as_it_is_where_everyone_takes_rows():
    stage = Stage()
    publisher = stage.rows()
    stage.hear_rows()
    publisher.publish(ROW, STAMP)
    stage.graph.run(STAMP + 1)
    assert stage.said == [SentRow(ROW, 'base_link')]
    assert stage.heard == [(ROW, 'base_link', STAMP)]


@pytest.mark.parametrize('why', ['the recording takes messages', 'someone listens to messages'])
def test_else_it_goes_as_a_message_that_tells_the_same(why):
    stage = Stage(takes_rows='recording' not in why)
    publisher = stage.rows()
    stage.hear_rows()
    if 'someone' in why:
        stage.hear_messages()
    assert not publisher.goes_as_it_is()
    publisher.publish(ROW, STAMP)
    stage.graph.run(STAMP + 1)
    message = codec(TwistStamped).decode(stage.said[0])
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (7, 3)
    assert (message.header.frame_id, message.twist.linear.x) == ('base_link', 0.5)
    assert stage.heard[0] == (ROW, 'base_link', STAMP)
    assert message in stage.heard[1:] or 'recording' in why


def test_a_node_does_not_hear_itself():
    stage = Stage()
    publisher = stage.rows()
    stage.speaker.active = True
    stage.speaker.listen(TwistStamped, 'cmd_vel', stage.heard.append, COMMAND)
    publisher.publish(ROW, STAMP)
    stage.graph.run(STAMP + 1)
    assert stage.heard == []


def test_listeners_are_counted_and_so_is_a_recording():
    stage = Stage()
    publisher = stage.speaker.publisher(Float64, 'number', COMMAND)
    assert publisher.get_subscription_count() == 0
    stage.listener.listen(Float64, 'number', stage.heard.append, COMMAND)
    stage.graph.recorded = {'/number'}
    assert publisher.get_subscription_count() == 2


def test_bytes_are_sent_as_they_are_and_messages_are_written():
    stage = Stage()
    publisher = stage.speaker.publisher(Float64, 'number', COMMAND)
    data = codec(Float64).encode(Float64(data=1.5))
    publisher.publish(Float64(data=1.5))
    publisher.publish(data)
    assert stage.said == [data, data]


def test_what_was_prepared_is_taken_in_place_of_the_messages():
    stage = Stage()
    ahead = Ahead(lambda messages, stamps: list(zip(messages, stamps, strict=True)),
                  lambda prepared: stage.heard.append(('prepared', prepared)))  # fmt: skip
    stage.listener.listen_ahead(Float64, 'number', stage.heard.append, ahead, COMMAND)
    data = [codec(Float64).encode(Float64(data=value)) for value in (1.0, 2.0)]
    stage.graph.look_ahead('/number', data[:1], [STAMP])
    for each in data:
        stage.graph.feed('/number', STAMP, each)
    assert stage.heard == [('prepared', (data[0], STAMP)), Float64(data=2.0)]
