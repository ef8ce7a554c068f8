"""What the sap flow says: how far the tree turns, and when it rests."""

from __future__ import annotations

from math import nan

import pytest

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.motion.behavior.sap_flow import (
    RestParameters,
    SapFlow,
    Sleep,
    checked_sap_flow,
)


def test_the_rotation_is_none_at_half_the_flow_and_full_at_both_ends():
    assert [SapFlow(0.0, s2, 0.0).rotation for s2 in (0.0, 0.5, 0.75, 1.0)] == [-1.0, 0.0, 0.5, 1.0]


def test_rest_has_hysteresis():
    sleep = Sleep(RestParameters(rest_below=0.1, wake_above=0.3))
    states = [sleep.update(SapFlow(s, s, s)) for s in (0.2, 0.31, 0.2, 0.11, 0.09, 0.2, 0.29, 0.3)]
    assert states == [True, False, False, False, True, True, True, False]


@pytest.mark.parametrize('flow', [(0.0, 0.5, 1.0), (1.0, 0.0, 0.5), (0.5, 1.0, 0.0)])
def test_both_ends_of_the_range_belong_to_it(flow):
    assert checked_sap_flow(SapFlow(*flow)) == flow


@pytest.mark.parametrize(
    'flow', [(nan, 0, 0), (0, 1.01, 0), (0, 0, -0.01), (-0.01, 0, 0), (0, nan, 0), (0, 0, 1.01),
             (1.01, 0, 0), (0, -0.01, 0), (0, 0, nan)],
)  # fmt: skip
def test_a_sap_flow_out_of_range_is_refused(flow):
    with pytest.raises(SignalError, match='sap flow'):
        checked_sap_flow(SapFlow(*flow))


def test_thresholds_that_contradict_each_other_are_refused():
    with pytest.raises(ConfigurationError, match='fall asleep at once'):
        RestParameters(rest_below=0.5, wake_above=0.4)
