"""Maps of what is remembered: none of a time that is not known yet."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.navigation.zone import Zone
from agv_motion.nodes.memory_store import MemoryStore
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
from agv_motion.reprocess.recorded import parameters
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode


class Port(SimpleNamespace):
    """What the store needs of a port, with a clock that a test sets."""

    def seconds(self):
        return self.now

    def publisher(self, _kind, topic, _qos):
        def publish(message):
            self.told.append((topic, message.header.stamp.sec))

        return SimpleNamespace(publish=publish)

    def every(self, period, callback, *, steady):
        assert steady
        self.timers[period] = callback

    def stamp(self, message):
        message.header.stamp.sec = int(self.now)


def test_the_first_map_waits_for_the_time_and_has_it_as_its_stamp():
    zone = Zone([(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)])
    port = Port(now=0.0, told=[], timers={})
    keeper = MemoryStore(port, Memory(zone), MotionGeneratorParameters(map_period=60.0))
    keeper.begin()
    keeper.publish_first()
    assert port.told == []
    port.now = 7.0
    keeper.publish_first()
    keeper.publish_first()
    assert port.told == [('memory/sap_flow', 7), ('memory/last_visit', 7)]


def test_a_node_that_began_before_the_clock_shows_the_first_map_as_soon_as_there_is_a_time():
    said = []
    graph = InProcessGraph(lambda publisher, stamp, _: said.append((publisher.topic, stamp)), 0)
    InProcessNode(graph, MotionGenerator, parameters('tree.yaml', 'motion_generator'))
    graph.start()
    assert '/memory/sap_flow' not in [topic for topic, _ in said]
    graph.run(1_000_000_000)
    assert ('/memory/sap_flow', 100_000_000) in said
    assert [topic for topic, _ in said].count('/memory/sap_flow') == 1
