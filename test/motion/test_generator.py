"""The equations of motion, and when the tree rests."""

from __future__ import annotations

from math import atan2, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.motion.generator import (
    Activity,
    MotionGenerator,
    RestParameters,
    SapFlow,
    checked_sap_flow,
    polar_command,
)
from agv_motion.motion.polar import STILL, checked
from agv_motion.planar import Pose

SHARE = st.floats(0.0, 1.0)
FLOWS = st.builds(SapFlow, SHARE, SHARE, SHARE)
POSES = st.builds(Pose, st.floats(-50, 50), st.floats(-50, 50), st.floats(-pi, pi - 1e-9))


def test_the_worked_example():
    """At (1, 1) looking along y, the goal (4, 5) bears atan2(4, 3); omega = 2 * 0.75 - 1."""
    command = polar_command(SapFlow(0.4, 0.75, 0.0), Pose(1.0, 1.0, pi / 2), (4.0, 5.0))
    assert command == pytest.approx((0.4, atan2(4.0, 3.0) - pi / 2, 0.5))


@given(FLOWS, POSES, st.tuples(st.floats(-50, 50), st.floats(-50, 50)))
def test_every_sap_flow_gives_a_command_in_its_domain(flow, pose, target):
    checked(polar_command(flow, pose, target))


def test_rest_has_hysteresis():
    generator = MotionGenerator(RestParameters(rest_below=0.1, wake_above=0.3))
    pose, goal = Pose(0.0, 0.0, 0.0), (5.0, 0.0)
    states = [
        generator.decide(SapFlow(s, s, s), pose, goal).command is STILL
        for s in (0.2, 0.31, 0.2, 0.11, 0.09, 0.2, 0.29, 0.3)
    ]
    assert states == [True, False, False, False, True, True, True, False]


def test_at_the_goal_it_turns_on_the_spot():
    generator = MotionGenerator(RestParameters(arrival=1.0))
    flow, pose = SapFlow(1.0, 0.9, 0.9), Pose(0.0, 0.0, 0.0)
    command, activity = generator.decide(flow, pose, (0.5, 0.5))
    assert activity is Activity.TURNING
    assert command == pytest.approx((0.0, 0.0, 0.8))


def test_noise_at_the_goal_does_not_send_it_to_and_fro():
    generator = MotionGenerator(RestParameters(arrival=1.0))
    flow, goal = SapFlow(1.0, 0.9, 0.9), (0.0, 0.0)
    seen = [
        generator.decide(flow, Pose(x, 0.0, 0.0), goal).activity
        for x in (1.1, 0.9, 1.1, 1.9, 2.1, 1.9)
    ]
    walking, turning = Activity.WALKING, Activity.TURNING
    assert seen == [walking, turning, turning, turning, walking, walking]
    assert generator.decide(flow, Pose(0.5, 0.0, 0.0), goal).activity is turning
    assert generator.decide(flow, Pose(0.5, 0.0, 0.0), (2.0, 0.0)).activity is walking


@pytest.mark.parametrize('flow', [(nan, 0, 0), (0, 1.01, 0), (0, 0, -0.01)])
def test_a_sap_flow_out_of_range_is_refused(flow):
    with pytest.raises(SignalError, match='sap flow'):
        checked_sap_flow(SapFlow(*flow))


def test_thresholds_that_contradict_each_other_are_refused():
    with pytest.raises(ConfigurationError, match='fall asleep at once'):
        RestParameters(rest_below=0.5, wake_above=0.4)
