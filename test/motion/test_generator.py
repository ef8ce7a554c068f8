"""The equations of motion, and when the tree rests."""

from __future__ import annotations

from math import atan2, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.motion.generator import (
    RestParameters,
    SapFlow,
    Sleep,
    checked_sap_flow,
    polar_command,
)
from agv_motion.motion.polar import checked
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
    sleep = Sleep(RestParameters(rest_below=0.1, wake_above=0.3))
    states = [sleep.feel(SapFlow(s, s, s)) for s in (0.2, 0.31, 0.2, 0.11, 0.09, 0.2, 0.29, 0.3)]
    assert states == [True, False, False, False, True, True, True, False]


@pytest.mark.parametrize('flow', [(nan, 0, 0), (0, 1.01, 0), (0, 0, -0.01)])
def test_a_sap_flow_out_of_range_is_refused(flow):
    with pytest.raises(SignalError, match='sap flow'):
        checked_sap_flow(SapFlow(*flow))


def test_thresholds_that_contradict_each_other_are_refused():
    with pytest.raises(ConfigurationError, match='fall asleep at once'):
        RestParameters(rest_below=0.5, wake_above=0.4)
