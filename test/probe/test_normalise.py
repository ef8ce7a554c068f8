"""Normalisation: between quantiles of the last days, or as the original installation did."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.probe.normalise import RunningQuantiles, RunningRange

QUARTER = 900.0


def quantiles(**changes):
    values = {
        'quantiles': (0.0, 1.0),
        'window_days': 1.0,
        'smallest_range': 1e-9,
        'learning_hours': 1.0,
    } | changes
    return RunningQuantiles(**values)


def test_nothing_is_told_while_learning():
    normaliser = quantiles()
    seen = [normaliser.update(i * QUARTER, float(i)) for i in range(6)]
    assert seen == [None, None, None, None, 1.0, 1.0]


def test_the_share_of_the_way_between_the_quantiles():
    """Hand calculation: bins 0, 1, 2, ..., 10; 2.5 is a quarter of the way."""
    normaliser = quantiles()
    for i in range(11):
        normaliser.update(i * QUARTER, float(i))
    assert normaliser.update(11 * QUARTER, 2.5) == pytest.approx(0.25)


def test_many_samples_in_a_bin_count_as_their_mean():
    coarse, fine = quantiles(), quantiles()
    for i in range(50):
        coarse.update(i * QUARTER, float(i % 7))
        for k in range(9):
            fine.update(i * QUARTER + k * 100.0, float(i % 7) + (k - 4) * 0.01)
    assert fine.update(50 * QUARTER, 3.0) == pytest.approx(coarse.update(50 * QUARTER, 3.0))


def test_a_spike_is_forgotten_after_the_window():
    normaliser = quantiles()
    for i in range(300):
        normaliser.update(i * QUARTER, 1000.0 if i == 10 else float(i % 2))
    assert normaliser.update(300 * QUARTER, 1.0) == pytest.approx(1.0)


def test_a_range_below_noise_is_not_blown_up():
    normaliser = quantiles(smallest_range=1.0)
    for i in range(20):
        normaliser.update(i * QUARTER, 0.001 * (i % 2))
    assert normaliser.update(20 * QUARTER, 0.001) == pytest.approx(0.001 * 0.001)


def test_a_range_of_half_the_noise_tells_half_of_half():
    normaliser = quantiles(smallest_range=2.0)
    for i in range(20):
        normaliser.update(i * QUARTER, float(i % 2))
    assert normaliser.update(20 * QUARTER, 1.0) == pytest.approx(0.25)


@given(st.lists(st.floats(0.0, 1e-4), min_size=10, max_size=60), st.integers(5, 9))
def test_the_future_never_changes_the_past(values, cut):
    whole, part = quantiles(), quantiles()
    told = [whole.update(i * QUARTER, v) for i, v in enumerate(values)]
    assert told[:cut] == [part.update(i * QUARTER, v) for i, v in enumerate(values[:cut])]
    assert all(share is None or 0.0 <= share <= 1.0 for share in told)


def test_the_original_gives_one_until_its_range_opens():
    normaliser = RunningRange(0.1)
    assert [normaliser.update(0.0, v) for v in (0.5, 0.55, 0.6)] == [1.0, 1.0, 1.0]
    assert normaliser.update(0.0, 0.7) == 1.0
    assert normaliser.update(0.0, 0.55) == pytest.approx(0.25)


@pytest.mark.parametrize('make', [quantiles, lambda: RunningRange(0.1)])
def test_a_restart_goes_on_where_it_was(make):
    values = np.random.default_rng(1).random(100)
    first, second = make(), make()
    for i, value in enumerate(values):
        first.update(i * QUARTER, value)
    first.update(100 * QUARTER, 0.5)
    second.restore(first.state())
    assert second.update(101 * QUARTER, 0.4) == pytest.approx(
        first.update(101 * QUARTER, 0.4), abs=0.02
    )
    with pytest.raises(ConfigurationError, match='delete the state file'):
        second.restore({})
