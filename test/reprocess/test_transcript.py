"""What nodes say lands in the bag in its order, many together or not."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from std_msgs.msg import Float64

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.planar import Twist
from agv_motion.reprocess.transcript import TOGETHER, Transcript
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_port import InProcessPort, Place
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.twist_rows import TwistRows


@pytest.mark.parametrize('takes_rows', [False, True])
def test_rows_and_messages_in_their_order(tmp_path, takes_rows):
    count = TOGETHER + 10
    with BagWriter(tmp_path / 'bag') as writer:
        transcript = Transcript(writer)
        graph = InProcessGraph(transcript.record, 100)
        graph.takes_rows = takes_rows
        port = InProcessPort(graph, Place('node', '/', {}), str)
        plain = port.publisher(Float64, 'number', COMMAND)
        rows = port.row_publisher(TwistRows('base_link'), 'cmd_vel', COMMAND)
        for i in range(count // 2):
            graph.now = 100 + 2 * i
            plain.publish(Float64(data=float(i)))
            graph.now += 1
            rows.publish(Twist(float(i), 0.0, -float(i)), graph.now)
        assert transcript.messages == TOGETHER
        transcript.flush()
        transcript.flush()
        assert transcript.messages == count
    with BagReader(tmp_path / 'bag') as bag:
        found = list(bag.messages())
    assert [message.stamp for message in found] == list(range(100, 100 + count))
    assert [m.connection.topic for m in found[:4]] == ['/number', '/cmd_vel'] * 2
    last = codec(rows.kind).decode(found[-1].data)
    assert (last.header.frame_id, last.header.stamp.nanosec) == ('base_link', found[-1].stamp)
    assert (last.twist.linear.x, last.twist.angular.z) == (count / 2 - 1, 1 - count / 2)
