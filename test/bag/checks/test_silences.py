"""Silences of a topic by its times, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.checks.silences import TopicSilence, regular, silences

STEADY = np.arange(0, 2000, 100)


def test_one_gap_in_ten_is_still_regular_two_are_not():
    """Of ten intervals one may be as long as it likes."""
    one = np.array([0, 100, 200, 300, 400, 500, 600, 700, 800, 900, 5000])
    assert regular(one)
    two = one.copy()
    two[-2] = 4000
    assert not regular(two)


@pytest.mark.parametrize(('step', 'fine'), [(149, True), (151, False), (67, True), (66, False)])
def test_what_counts_as_near_the_median(step, fine):
    """Of twenty intervals four are others: too many, unless they are near."""
    steps = [100] * 16 + [step] * 4
    assert regular(np.cumsum([0, *steps])) is fine


def test_few_messages_or_no_time_between_them_are_not_regular():
    assert not regular(STEADY[:9])
    assert regular(STEADY[:10])
    assert not regular(np.zeros(20, np.int64))
    assert regular(STEADY[::-1])
    assert regular(np.arange(20))


def test_a_silence_tells_what_is_missing():
    stamps = np.array([0, 100, 200, 900, 1000, 1340])
    assert silences(stamps[::-1], 2.0) == [
        TopicSilence(200, 700, 100, 6), TopicSilence(1000, 340, 100, 2),
    ]  # fmt: skip
    assert silences(stamps, 4.0) == [TopicSilence(200, 700, 100, 6)]
    assert silences(stamps, 7.0) == []
    assert silences(stamps * 10**9, 2.0, longer=500.0)[0].length == 700 * 10**9
    assert len(silences(stamps * 10**9, 2.0, longer=500.0)) == 1


def test_without_intervals_there_is_none():
    assert silences(np.array([5]), 2.0) == []
    assert silences(np.array([], np.int64), 2.0) == []
    assert silences(np.array([0, 0, 0, 9]), 2.0) == [TopicSilence(0, 9, 0, 0)]
