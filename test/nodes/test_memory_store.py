"""Maps of what is remembered: none of a time that is not known yet."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.navigation.zone import Zone
from agv_motion.nodes.memory_store import FIRST_PERIOD, MemoryStore
from agv_motion.nodes.motion_parameters import MotionGeneratorParameters


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
    port.timers[FIRST_PERIOD]()
    assert port.told == []
    port.now = 7.0
    port.timers[FIRST_PERIOD]()
    port.timers[FIRST_PERIOD]()
    assert port.told == [('memory/sap_flow', 7), ('memory/last_visit', 7)]
