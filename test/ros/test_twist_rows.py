"""Twists as messages, one or many, and cmd_vel with a stamp or without."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped

from agv_motion.errors import SignalError
from agv_motion.planar import Twist
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.row_table import Table
from agv_motion.ros.twist_rows import TwistRows, twist_publisher

ROWS = [Twist(1.0, 2.0, 3.0), Twist(-4.0, 0.0, 0.5)]


def test_there_and_back():
    rows = TwistRows('base_link')
    message = rows.message()
    rows.fill(message, ROWS[0])
    assert rows.read(message) == ROWS[0]
    assert message.header.frame_id == 'base_link'
    message.twist.angular.z = inf
    with pytest.raises(SignalError, match='finite'):
        rows.read(message)


def test_many_together_are_the_bytes_of_each():
    rows, codes, wanted = TwistRows('base_link'), codec(TwistStamped), []
    for row, stamp in zip(ROWS, (5, 1_000_000_007), strict=True):
        message = rows.message()
        rows.fill(message, row)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, 10**9)
        wanted.append(codes.encode(message))
    assert Table(rows).messages(np.array([5, 1_000_000_007]), ROWS) == wanted


@pytest.mark.parametrize('stamped', [True, False])
def test_a_command_has_a_stamp_where_it_is_wanted(stamped):
    said = []
    graph = InProcessGraph(lambda publisher, _, data: said.append((publisher.kind, data)), 7)
    port = InProcessPort(graph, Place('node', '/oak', {}), str)
    command = twist_publisher(port, 'base_link', stamped=stamped)
    command(ROWS[0])
    ((kind, data),) = said
    message = codec(kind).decode(data)
    assert kind is (TwistStamped if stamped else TwistMessage)
    twist = message.twist if stamped else message
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == ROWS[0]
    if stamped:
        assert (message.header.stamp.nanosec, message.header.frame_id) == (7, 'base_link')
    command(Twist(-0.0, -0.0, -0.0))
    rest = codec(kind).decode(said[-1][1])
    assert '-0.0' not in str(rest)
