"""Each gate lets its limit through and refuses what lies beyond, by name, with a remedy."""

from __future__ import annotations

from itertools import product
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.gates import (
    MAX_DEVIATION,
    MAX_TURN_DEVIATION,
    MIN_DEVIATION,
    is_noise,
    require_measurement,
    require_noise,
    require_within,
)

GOOD = Covariance(0.04, 0.01, 0.002, 0.09, -0.003, 0.01)


def test_a_limit_is_allowed_on_both_sides_and_no_more():
    require_within('way', (3.0, -3.0), 3.0, 'm', 'drive less')
    require_within('way', (), 3.0, 'm', 'drive less')
    with pytest.raises(SignalError, match=r'way = 3\.1 m: cannot be beyond 3 m; drive less'):
        require_within('way', (0.0, -3.1), 3.0, 'm', 'drive less')
    for bad in (nan, inf):
        with pytest.raises(SignalError, match='way'):
            require_within('way', (0.0, bad), 3.0, 'm', 'drive less')


def test_a_sound_measurement_passes_with_heading_and_without():
    require_measurement('fix', GOOD, heading=True)
    require_measurement('fix', GOOD._replace(xt=nan, yt=inf, tt=-1.0), heading=False)


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        ({'xx': 0.0}, 'not positive definite'),
        ({'xy': 0.06}, 'not positive definite'),  # sqrt(0.04 * 0.09)
        ({'xy': -0.06}, 'not positive definite'),
        ({'xt': 0.02}, 'not positive definite'),
        ({'yt': 0.03}, 'not positive definite'),
        ({'tt': nan}, 'finite'),
        ({'xx': 1.1 * MAX_DEVIATION**2}, 'of the position tells nothing, the limit is 10000 m'),
        ({'yy': 1.1 * MAX_DEVIATION**2}, 'not positive definite|position tells nothing'),
        ({'tt': 1.1 * MAX_TURN_DEVIATION**2}, 'rad of the heading tells nothing'),
    ],
)
def test_an_unsound_one_is_refused_by_name(change, words):
    with pytest.raises(SignalError, match=words):
        require_measurement('fix', GOOD._replace(**change), heading=True)


def test_nothing_is_measured_better_than_a_micrometre():
    small = MIN_DEVIATION**2
    require_measurement('fix', Covariance(small, 0.0, 0.0, small, 0.0, small), heading=True)
    with pytest.raises(SignalError, match='less than 1e-06: nothing is measured that well'):
        require_measurement(
            'fix', Covariance(0.9 * small, 0.0, 0.0, small, 0.0, small), heading=True
        )


def test_noise_may_be_none_at_all_but_not_less():
    require_noise('odom', Covariance(*[0.0] * 6))
    require_noise('odom', GOOD)
    for change in (
        {'xx': -1e-9},
        {'tt': -1e-9},
        {'yy': 2 * MAX_DEVIATION**2},
        {'xy': 0.061},
        {'tt': 2 * MAX_TURN_DEVIATION**2},
    ):
        with pytest.raises(SignalError, match=r'odom: covariance .* is none'):
            require_noise('odom', GOOD._replace(**change))


@pytest.mark.parametrize('name', ['xx', 'yy', 'tt'])
def test_a_variance_may_lack_what_rounding_takes(name):
    lacking = Covariance(*[0.0] * 6)._replace(**{name: -1e-12})
    assert is_noise(lacking, 1e-12)
    assert not is_noise(lacking, 0.9e-12)


@settings(max_examples=60)
@given(st.lists(st.floats(-3.0, 3.0), min_size=9, max_size=9))
def test_every_square_of_a_matrix_is_noise(numbers):
    a, b, c = numbers[:3], numbers[3:6], numbers[6:]
    dot = [[sum(x * y for x, y in zip(u, v, strict=True)) for v in (a, b, c)] for u in (a, b, c)]
    square = Covariance(dot[0][0], dot[0][1], dot[0][2], dot[1][1], dot[1][2], dot[2][2])
    assert is_noise(square, 1e-9)


@pytest.mark.parametrize('values', [(nan, 0.0), (0.0, nan), (0.0, nan, 1.0), (0.0, -inf)])
def test_what_is_no_number_is_noticed_wherever_it_stands(values):
    """The greatest of 0 and NaN is 0: a comparison with that alone let NaN through."""
    with pytest.raises(SignalError, match='way'):
        require_within('way', values, 3.0, 'm', 'drive less')


def test_three_correlations_pass_where_all_axes_keep_a_variance():
    """Each of them may be possible, and not all three: numpy's eigenvalues tell."""
    for size, signs in product((0.3, 0.6, 0.8), product((-1.0, 0.0, 1.0), repeat=3)):
        passes_where_all_axes_keep_a_variance(size, signs)


def passes_where_all_axes_keep_a_variance(size, signs):
    xy, xt, yt = (size * sign for sign in signs)
    scale = np.diag([2.0, 0.5, 0.1])
    shape = np.array([[1.0, xy, xt], [xy, 1.0, yt], [xt, yt, 1.0]])
    matrix = scale @ shape @ scale
    covariance = Covariance(*map(float, matrix[np.triu_indices(3)]))
    least = float(np.linalg.eigvalsh(shape)[0])
    assert abs(least) > 0.01
    if least > 0.0:
        require_measurement('fix', covariance, heading=True)
        return
    with pytest.raises(SignalError, match='not positive definite'):
        pytest.fail(f'{require_measurement("fix", covariance, heading=True)} of {size} {signs}')
