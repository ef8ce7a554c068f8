"""Position fixes: what is no measurement is refused, by name."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.fix import Fix, position_fix

GOOD = Covariance(0.02, 0.01, 0.0, 0.02, 0.0, 0.1)


@pytest.mark.parametrize(
    'covariance',
    [
        Covariance(0.0, 0.0, 0.0, 0.02, 0.0, 0.1),
        Covariance(-0.02, 0.0, 0.0, 0.02, 0.0, 0.1),
        Covariance(0.02, 0.02, 0.0, 0.02, 0.0, 0.1),
        Covariance(0.02, 0.03, 0.0, 0.02, 0.0, 0.1),
    ],
)
@pytest.mark.parametrize('heading', [None, 0.5])
def test_a_covariance_that_is_not_positive_definite_is_refused_by_name(covariance, heading):
    with pytest.raises(SignalError, match=r'fix at 7\.5 s: covariance .* is not positive definite'):
        Fix(7.5, 1.0, 2.0, covariance, heading)


def test_the_variance_of_a_heading_counts_only_with_a_heading():
    unknown = Covariance(0.02, 0.0, nan, 0.02, inf, 0.0)
    assert Fix(7.5, 1.0, 2.0, unknown).heading is None
    with pytest.raises(SignalError, match=r'covariance of fix at .* must be finite'):
        Fix(7.5, 1.0, 2.0, unknown, 0.5)
    with pytest.raises(SignalError, match='not positive definite'):
        Fix(7.5, 1.0, 2.0, Covariance(0.02, 0.0, 0.0, 0.02, 0.0, 0.0), 0.5)


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_numbers_that_are_not_finite_are_refused(bad):
    for stamp, x, y in ((bad, 0.0, 0.0), (0.0, bad, 0.0), (0.0, 0.0, bad)):
        with pytest.raises(SignalError, match=r'fix \(stamp, x, y\) must be finite'):
            Fix(stamp, x, y, GOOD)
    with pytest.raises(SignalError, match='heading of a fix must be finite'):
        Fix(0.0, 0.0, 0.0, GOOD, bad)
    with pytest.raises(SignalError, match=r'covariance of fix at .* must be finite'):
        Fix(0.0, 0.0, 0.0, Covariance(bad, 0.0, 0.0, 0.02, 0.0, 0.1))


@pytest.mark.parametrize('deviation', [0.0, -0.15])
def test_a_deviation_is_above_zero(deviation):
    with pytest.raises(SignalError, match='not positive definite'):
        position_fix(0.0, 0.0, 0.0, deviation)


def test_a_plain_position_fix():
    assert position_fix(1.0, 2.0, 3.0, 0.5).covariance[:4] == (0.25, 0.0, 0.0, 0.25)
