"""A decision to stay asks for nothing."""

from __future__ import annotations

from agv_motion.motion.behavior.decision import Decision
from agv_motion.motion.command.limits import FloorRules


def test_a_decision_without_more_stays_where_it_is_whoever_comes():
    stay = Decision('resting', None)
    assert (stay.destination, stay.speed, stay.rotation, stay.yield_speed) == (None, 0.0, 0.0, 0.0)
    assert stay.rules == FloorRules()
