"""A decision to stay asks for nothing."""

from __future__ import annotations

from agv_motion.activity import Activity, Cause
from agv_motion.motion.behavior.decision import Decision, resting, standing, stopped
from agv_motion.motion.command.floor_rules import FloorRules


def test_a_decision_without_more_stays_where_it_is_whoever_comes():
    stay = Decision('resting', None)
    assert (stay.destination, stay.speed, stay.rotation, stay.yield_speed) == (None, 0.0, 0.0, 0.0)
    assert stay.rules == FloorRules()


def test_what_stands_says_why_in_words_and_for_programs():
    rest = resting('the sap stands', None, Cause.SAP, 0.4)
    assert (rest.state, rest.activity, rest.because) == (
        'resting: the sap stands', Activity.RESTING, Cause.SAP,
    )  # fmt: skip
    assert (rest.destination, rest.yield_speed) == (None, 0.4)
    stop = stopped('no way', None)
    assert (stop.state, stop.activity, stop.because) == (
        'stopped: no way', Activity.STOPPED, Cause.ZONE,
    )  # fmt: skip
    closed = standing('resting: closed', None, Activity.CLOSED, Cause.HOURS)
    assert (closed.activity, closed.because, closed.yield_speed) == (
        Activity.CLOSED, Cause.HOURS, 0.0,
    )  # fmt: skip
