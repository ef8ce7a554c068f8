"""Which readings are believed."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.probe.quality import Quality, ReadingJudge

STEP = 900.0


def judged(values, *, flowing=True, step=STEP):
    judge = ReadingJudge(1.0, 60.0, 0.15, (4 * 3600.0, 18 * 3600.0))
    return [judge.judge(i * step, v, flowing=flowing) for i, v in enumerate(values)]


LEVEL = [20.0, 20.1, 19.9, 20.0, 20.2, 20.1]


@pytest.mark.parametrize(
    ('value', 'quality'),
    [
        (nan, Quality.MISSING), (inf, Quality.MISSING), (0.0, Quality.OFF), (-0.3, Quality.OFF),
        (61.0, Quality.OUT_OF_RANGE), (29.0, Quality.SPIKE), (12.0, Quality.SPIKE),
        (20.3, Quality.GOOD),
    ],
)  # fmt: skip
def test_each_kind(value, quality):
    assert judged([*LEVEL, value])[-1] is quality


def test_after_a_spike_the_level_goes_on():
    assert judged([*LEVEL, 29.0, 20.0])[-1] is Quality.GOOD


def test_a_change_that_lasts_becomes_the_level():
    qualities = judged([*LEVEL, 29.0, 29.1, 29.0, 29.2])
    assert qualities[-4:] == [Quality.SPIKE, Quality.SPIKE, Quality.GOOD, Quality.GOOD]


def test_the_same_value_for_hours_is_stuck_sooner_while_sap_flows():
    values = [*LEVEL, *[19.5] * 40]
    assert judged(values)[6 + 15] is Quality.GOOD
    assert judged(values)[6 + 16] is Quality.STUCK
    assert judged(values, flowing=False)[-1] is Quality.GOOD


def test_stuck_counts_time_not_samples():
    assert judged([19.5] * 1000, step=0.1)[-1] is Quality.GOOD


def test_after_a_long_gap_a_new_level_is_taken_at_once():
    judge = ReadingJudge(1.0, 60.0, 0.15, (4 * 3600.0, 18 * 3600.0))
    for i, value in enumerate(LEVEL):
        judge.judge(i * STEP, value, flowing=True)
    assert judge.judge(7 * 3600.0 + 6 * STEP, 29.0, flowing=True) is Quality.GOOD


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), max_size=50))
def test_whatever_comes_only_finite_values_in_range_are_usable(values):
    for value, quality in zip(values, judged(values), strict=True):
        assert not quality.usable or 1.0 <= value <= 60.0
