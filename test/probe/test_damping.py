"""Old probes: the gain of a curve by hand, its limits, and the curve found again in its values."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.probe.damping import Damping, DampingParameters, fit_damping

DAY = 86400.0
SET = 1_365_724_800.0
"""[s] since 1970: 12 April 2013"""
CURVE = {'a': 0.4, 'b': 0.001, 'c': 0.01, 'd': 2e-5}


def test_without_a_day_nothing_is_corrected():
    assert Damping(DampingParameters(**CURVE)).gain(2e9) == 1.0


def test_a_year_by_hand():
    """f(365) = (0.4 + 0.365) / (1 + 3.65 + 2.6645) = 0.104587; f(0) = 0.4: gain 3.82457."""
    damping = Damping(DampingParameters(installed='2013-04-12', **CURVE))
    assert damping.gain(SET + 365.0 * DAY) == pytest.approx(3.8245751, rel=1e-7)
    assert damping.gain(SET) == damping.gain(SET - DAY) == 1.0


def test_where_nothing_is_left_the_gain_ends_at_ten():
    damping = Damping(DampingParameters(installed='2013-04-12', a=1.0, b=-0.01))
    assert damping.gain(SET + 80.0 * DAY) == pytest.approx(5.0)
    assert damping.gain(SET + 99.0 * DAY) == damping.gain(SET + 900.0 * DAY) == 10.0


def test_the_curve_is_found_in_its_values():
    days = np.arange(0.0, 900.0, 7.0)
    values = (0.4 + 0.001 * days) / (1.0 + 0.01 * days + 2e-5 * days**2)
    assert fit_damping(days, values) == pytest.approx(tuple(CURVE.values()), rel=1e-6)
    assert fit_damping(days[::17], values[::17]) == pytest.approx(tuple(CURVE.values()), rel=1e-6)
    assert len(days[::17]) == 8
    noisy = values * (1.0 + 0.01 * np.random.default_rng(3).normal(size=len(days)))
    a, b, c, d = fit_damping(days, noisy)
    again = (a + b * days) / (1.0 + c * days + d * days**2)
    assert np.abs(again / values - 1.0).max() < 0.03


@pytest.mark.parametrize(
    ('days', 'values'),
    [
        ([1.0, 2.0], [0.1, 0.1]),
        (np.arange(9.0), np.arange(8.0)),
        (np.arange(7.0),) * 2,
        (np.zeros((8, 2)),) * 2,
        ([0.0] * 4 + [1.0, 2.0, 3.0, 4.0], np.ones(8)),
    ],
)
def test_too_little_to_fit_is_refused(days, values):
    with pytest.raises(SignalError, match='eight days'):
        fit_damping(days, values)


@pytest.mark.parametrize('wrong', [np.nan, np.inf])
def test_what_is_not_finite_is_refused(wrong):
    values = np.arange(9.0)
    with pytest.raises(SignalError, match='must be finite'):
        fit_damping(values, np.where(values == 3.0, wrong, values))
    with pytest.raises(SignalError, match='must be finite'):
        fit_damping(np.where(values == 3.0, wrong, values), values)


@pytest.mark.parametrize('day', ['12.4.2013', '2013-13-01', 'yesterday'])
def test_what_is_no_day_is_refused(day):
    with pytest.raises(ConfigurationError, match='YYYY-MM-DD'):
        DampingParameters(installed=day)
