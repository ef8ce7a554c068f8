"""The pace of the Ghost: full pace, dawdling, waiting, lost; and never a jump."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory.pace import PaceController, PaceParameters
from agv_motion.trajectory.tracking import TrackingError

GIVEN = PaceParameters(slow_beyond=0.1, wait_beyond=0.2, lost_beyond=0.5, heading_arm=0.2, ease=0.5)


def eased(separation, seconds=5.0, **kind):
    control = PaceController(GIVEN)
    control.restart(moving=True)
    control.ease(separation, seconds, **kind)
    return control.pace


@pytest.mark.parametrize(
    ('separation', 'pace'), [(0.0, 1.0), (0.1, 1.0), (0.15, 0.5), (0.2, 0.0), (0.4, 0.0)]
)
def test_the_pace_falls_from_slow_to_wait(separation, pace):
    assert eased(separation) == pytest.approx(pace, abs=1e-12)


def test_held_it_stops_whatever_the_distance():
    assert eased(0.0, hold=True) == 0.0


@given(st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 0.1)), max_size=30))
def test_the_pace_changes_no_faster_than_its_ease(calls):
    control = PaceController(GIVEN)
    for separation, dt in calls:
        before = control.pace
        after = control.ease(separation, dt)
        assert 0.0 <= after <= 1.0
        assert abs(after - before) <= dt / 0.5 + 1e-12


def test_an_error_of_heading_counts_too():
    """Hand calculation: 0.05 m by 3-4-5, and 0.2 m/rad times 0.5 rad."""
    control = PaceController(GIVEN)
    assert control.separation(TrackingError(0.03, -0.04, -0.5)) == pytest.approx(0.15)
    assert not control.is_lost(0.499)
    assert control.is_lost(0.5)


@pytest.mark.parametrize('change', [{'slow_beyond': 0.3}, {'lost_beyond': 0.2}])
def test_distances_out_of_order_are_refused(change):
    with pytest.raises(ConfigurationError, match='in this order, rising'):
        PaceParameters(**change)


@pytest.mark.parametrize('bad', [nan, inf, 0.0, -1.0])
def test_distances_that_cannot_be_are_refused(bad):
    with pytest.raises(ConfigurationError, match='slow_beyond'):
        PaceParameters(slow_beyond=bad)
