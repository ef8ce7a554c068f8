"""The probe on a recording takes the readings that were recorded, and no others."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from sensor_msgs.msg import Temperature

from agv_motion.reprocess.recorded_probe import RecordedProbe
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
READING = codec(Temperature)


def test_a_recorded_reading_is_said_again_with_its_value():
    """The simulated source, which would tell another one, is not asked."""
    said = []

    def record(publisher, _, data):
        if publisher.topic.endswith('/temperature_difference'):
            said.append((publisher.topic, READING.decode(data).temperature))

    graph = InProcessGraph(record, NOON)
    graph.recorded = ('/granier/probe_1/temperature_difference',)
    InProcessNode(graph, RecordedProbe, {'source': 'simulated'})
    graph.start()
    topic = '/granier/probe_1/temperature_difference'
    for second, value in ((5, 7.25), (15, 7.5)):
        message = Temperature(temperature=value)
        message.header.stamp = stamp_of(NOON + second * SECOND)
        graph.feed(topic, NOON + second * SECOND, READING.encode(message))
        graph.run(NOON + (second + 9) * SECOND)
    graph.stop()
    ours = [value for name, value in said if name == topic]
    assert ours
    assert set(ours) <= {7.25, 7.5}
