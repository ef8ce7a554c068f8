"""Quantiles of the chi-square distribution, as in the tables."""

from __future__ import annotations

from math import log

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.odometry.chi_square import chi_square_quantile


def test_two_degrees_are_exact():
    """The square of a radius: 1 - exp(-x / 2)."""
    for probability in (0.1, 0.5, 0.99):
        found = chi_square_quantile(probability, 2)
        assert found == pytest.approx(-2.0 * log(1.0 - probability))


@pytest.mark.parametrize(
    ('probability', 'degrees', 'table'),
    [
        (0.95, 1, 3.8415),
        (0.99, 2, 9.2103),
        (0.95, 3, 7.8147),
        (0.99, 10, 23.209),
        (0.5, 100, 99.334),
    ],
)
def test_quantiles_as_in_the_tables(probability, degrees, table):
    assert chi_square_quantile(probability, degrees) == pytest.approx(table, rel=0.006)


@pytest.mark.parametrize(('probability', 'degrees'), [(0.0, 1), (1.0, 1), (0.5, 0)])
def test_an_impossible_quantile_is_refused(probability, degrees):
    with pytest.raises(ConfigurationError, match='probability = '):
        chi_square_quantile(probability, degrees)
