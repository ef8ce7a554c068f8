"""Litres over midnights and restarts, by hand; and in words."""

from __future__ import annotations

from itertools import pairwise
from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.probe.water import Litres
from agv_motion.report.litres import LitresDrunk, in_litres


def told(*values):
    """Return what was drunk where each amount has an interval of a factor of two."""
    drunk = LitresDrunk()
    for value in values:
        assert drunk.add(value, value / 2.0, value * 2.0)
    return drunk


def test_what_was_drunk_before_the_first_word_is_not_counted():
    """From 3 to 4 litres: 1, with the interval of a factor of two."""
    assert told(3.0, 3.5, 4.0).total() == pytest.approx((1.0, 0.5, 2.0))
    assert told(3.0, 3.5, 4.0).since_midnight() == (4.0, 2.0, 8.0)


def test_a_midnight_or_a_restart_begins_at_nothing():
    """1 litre of the first day, 5 of the second, 2 of the third."""
    drunk = told(3.0, 4.0, 0.0, 2.5, 5.0, 0.1, 2.0)
    assert drunk.total() == pytest.approx((8.0, 4.0, 16.0))
    assert drunk.stretches == 3
    assert drunk.since_midnight() == (2.0, 1.0, 4.0)


@given(st.lists(st.floats(0.0, 100.0), min_size=1, max_size=20))
def test_the_total_is_the_sum_of_all_that_it_rose(steps):
    values, until = [], 0.0
    for step in steps:
        until = 0.0 if step > 90.0 else until + step
        values.append(until)
    risen = sum(b - a if b >= a else b for a, b in pairwise(values) if b != a)
    total = told(*values).total()
    assert total.value == pytest.approx(risen, abs=1e-4)
    assert total.low <= total.value <= total.high


@pytest.mark.parametrize('wrong', [(nan, 0.0, 1.0), (1.0, -inf, 1.0), (1.0, 0.5, inf)])
def test_what_is_no_number_is_refused(wrong):
    drunk = LitresDrunk()
    assert not drunk.add(*wrong)
    assert drunk.total() is None
    assert drunk.since_midnight() is None


@pytest.mark.parametrize(
    ('litres', 'words'),
    [
        ((12.34, 10.06, 15.0), '12.3 L (10.1 to 15.0)'),
        ((0.284, 0.089, 0.899), '0.28 L (0.09 to 0.90)'),
        ((0.0, 0.0, 0.0), '0.00 L (0.00 to 0.00)'),
    ],
)
def test_in_words(litres, words):
    assert in_litres(Litres(*litres)) == words
