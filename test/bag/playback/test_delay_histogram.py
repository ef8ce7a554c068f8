"""How late messages were, by hand."""

from __future__ import annotations

import pytest

from agv_motion.bag.playback.delay_histogram import BINS, RESOLUTION, DelayHistogram


def of(*delays):
    histogram = DelayHistogram()
    for delay in delays:
        histogram.add(delay)
    return histogram


def test_quantiles_are_right_to_a_bin():
    histogram = of(*(k * 1e-3 + 5e-6 for k in range(100)))
    assert histogram.count == 100
    assert histogram.quantile(0.5) == pytest.approx(0.049, abs=2 * RESOLUTION)
    assert histogram.quantile(0.99) == pytest.approx(0.098, abs=2 * RESOLUTION)
    assert histogram.quantile(1.0) == histogram.worst == pytest.approx(0.099005)
    assert histogram.share_within(0.002) == pytest.approx(0.02)


def test_beyond_the_bins_only_the_worst_is_known():
    far = BINS * RESOLUTION
    histogram = of(1e-3, 2.0 * far, 3.0 * far)
    assert histogram.quantile(0.9) == histogram.worst == pytest.approx(3.0 * far)
    assert histogram.share_within(2.0 * far) == pytest.approx(1.0)
    assert histogram.share_within(0.5 * far) == pytest.approx(1 / 3)


def test_who_comes_early_is_not_late():
    histogram = of(-1.0, -1e-9)
    assert (histogram.worst, histogram.quantile(0.99)) == (0.0, 0.0)
    assert histogram.share_within(RESOLUTION) == 1.0


def test_without_messages_nothing_was_late():
    histogram = of()
    assert (histogram.quantile(0.99), histogram.share_within(0.002)) == (0.0, 1.0)
    assert str(of(1e-3, 3e-3)).startswith('2 messages, late by 1.01 ms (median)')
    assert str(of(1e-3, 3e-3)).endswith('3.00 ms (worst); 50.0% within 2 ms')
