"""Normalisation: between quantiles of the last days, or as the original installation did."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.probe.normalise import RecentMeans, RunningQuantiles, RunningRange

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


def test_bins_have_their_means_and_those_of_the_last_day_count():
    """Bins of 10 s and a window of 30 s: by their begins, a bin once the next has begun."""
    means = RecentMeans(30.0, 10.0)
    for time, value in ((0.0, 1.0), (9.0, 3.0), (10.0, 7.0), (25.0, 5.0)):
        means.add(time, value)
    assert means.finished() == [[0.0, 2.0], [10.0, 7.0]]
    assert [means.quantile(share) for share in (0.0, 0.49, 0.5, 1.0)] == [2.0, 2.0, 7.0, 7.0]
    means.add(30.0, 9.0)
    assert means.finished() == [[0.0, 2.0], [10.0, 7.0], [20.0, 5.0]]
    means.add(31.0, 9.0)
    assert means.finished() == [[10.0, 7.0], [20.0, 5.0]]
    assert len(means) == 2
    assert [means.quantile(share) for share in (0.0, 1.0)] == [5.0, 7.0]


@pytest.mark.parametrize(
    ('since', 'bins'),
    [(20.1, [0.0, 10.0]), (20.0, [0.0, 10.0]), (19.9, [0.0]), (10.0, [0.0]), (0.0, [])],
)
def test_what_is_distrusted_is_forgotten_with_its_bin(since, bins):
    """The open one too: what comes later begins it anew."""
    means = RecentMeans(1000.0, 10.0)
    for time in range(25):
        means.add(float(time), 100.0 - time)
    means.distrust(since)
    assert [time for time, _ in means.finished()] == bins
    assert len(means) == len(bins)
    means.add(26.0, 7.0)
    means.add(30.0, 1.0)
    assert means.finished()[-1] == [20.0, 7.0]
    assert means.quantile(0.0) == 7.0


def test_a_day_of_history_is_needed_unless_it_is_told():
    normaliser = RunningQuantiles((0.0, 1.0), 7.0, 1.0)
    told = [normaliser.update(k * QUARTER, float(k % 2)) for k in range(98)]
    assert told[:96] == [None] * 96
    assert told[96] is not None
    assert RecentMeans(1.0, 1.0).finished() == []


def test_the_window_is_of_whole_days():
    """A spike counts for a day, and no longer."""
    normaliser = quantiles(window_days=1.0)
    normaliser.update(0.0, 100.0)
    shares = [normaliser.update(k * QUARTER, float(k % 2)) for k in range(1, 100)]
    assert shares[94] == pytest.approx(0.01)
    assert [shares[96], shares[98]] == [1.0, 1.0]


def test_a_range_far_from_zero_is_as_good_and_one_of_nothing_is_no_range():
    normaliser = quantiles(smallest_range=4.0)
    for i in range(20):
        normaliser.update(i * QUARTER, 5.0 + 2.0 * (i % 2))
    assert normaliser.update(20 * QUARTER, 6.0) == pytest.approx(0.5 * 0.25)
    normaliser = quantiles(smallest_range=0.0)
    for i in range(20):
        normaliser.update(i * QUARTER, 5.0 + 2.0 * (i % 2))
    assert normaliser.update(20 * QUARTER, 6.0) == pytest.approx(0.5)


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


@pytest.mark.parametrize(
    ('ends', 'share'), [([0.2, 0.7], 0.5), ([0.7, 0.2], 0.5), ([None] * 2, 1.0)]
)
def test_the_original_takes_up_its_range_or_none(ends, share):
    normaliser = RunningRange(0.1)
    normaliser.restore({'range': ends})
    assert normaliser.update(0.0, 0.45) == pytest.approx(share)
    for bad in ([0.2, None], [None, 0.7], [0.2, float('nan')]):
        with pytest.raises(ConfigurationError, match='saved range is unreadable'):
            normaliser.restore({'range': bad})
