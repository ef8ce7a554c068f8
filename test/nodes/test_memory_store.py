"""Maps of what is remembered: none of a time that is not known yet."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.navigation.zone import Zone
from agv_motion.nodes.memory_store import FIRST_PERIOD, MemoryStore


class Node(SimpleNamespace):
    """What the keeper needs of its node, with a clock that a test sets."""

    def seconds(self):
        return self.now

    def publisher(self, _kind, topic, _qos):
        def publish(message):
            self.told.append((topic, message.header.stamp.sec))

        return SimpleNamespace(publish=publish)

    def every(self, period, callback, _clock=None):
        self.timers[period] = callback

    def stamp(self, message):
        message.header.stamp.sec = int(self.now)


def test_the_first_map_waits_for_the_time_and_has_it_as_its_stamp():
    zone = Zone([(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)])
    node = Node(now=0.0, told=[], timers={}, parameters=SimpleNamespace(map_period=60.0))
    keeper = MemoryStore(node, Memory(zone), '', 'map', 24.0)
    keeper.begin()
    node.timers[FIRST_PERIOD]()
    assert node.told == []
    node.now = 7.0
    node.timers[FIRST_PERIOD]()
    node.timers[FIRST_PERIOD]()
    assert node.told == [('memory/sap_flow', 7), ('memory/last_visit', 7)]
