"""Covariances under a change of frame: the adjoint of SE(2), written out."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.odometry.covariance import (
    Covariance,
    add,
    is_positive_definite,
    rotate,
    scale,
    shift,
)

NUMBER = st.floats(-5.0, 5.0)
ANGLE = st.floats(-pi, pi)


def matrix(covariance):
    xx, xy, xt, yy, yt, tt = covariance
    return np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])


@st.composite
def covariances(draw):
    root = np.array(draw(st.lists(NUMBER, min_size=9, max_size=9))).reshape(3, 3)
    return Covariance(*(root @ root.T)[np.triu_indices(3)])


@given(covariances(), ANGLE)
def test_turning_is_the_congruence_by_a_rotation(covariance, angle):
    turn = np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])
    expected = turn @ matrix(covariance) @ turn.T
    np.testing.assert_allclose(matrix(rotate(covariance, angle)), expected, atol=1e-12)


@given(covariances(), NUMBER, NUMBER)
def test_shifting_is_the_congruence_by_the_lever(covariance, x, y):
    lever = np.array([[1, 0, -y], [0, 1, x], [0, 0, 1]])
    expected = lever @ matrix(covariance) @ lever.T
    np.testing.assert_allclose(matrix(shift(covariance, x, y)), expected, atol=1e-11, rtol=1e-12)


def test_an_uncertain_heading_makes_the_position_uncertain_with_the_distance():
    """Hand calculation: 0.1 rad at 2 m along x is 0.2 m sideways, wholly correlated."""
    seen = shift(Covariance(0, 0, 0, 0, 0, 0.01), 2.0, 0.0)
    assert seen == pytest.approx((0, 0, 0, 0.04, 0.02, 0.01), abs=1e-17)


@given(covariances(), covariances(), st.floats(0, 10))
def test_sums_and_multiples(first, second, factor):
    expected = matrix(first) + factor * matrix(second)
    np.testing.assert_allclose(matrix(add(first, scale(second, factor))), expected, rtol=1e-12)


@pytest.mark.parametrize(
    ('covariance', 'expected'),
    [
        ((1, 0, 0, 1, 0, 1), True),
        ((1, 0.9, 0.8, 1, 0.9, 1), True),
        ((1, 2, 0, 1, 0, 1), False),
        ((-1, 0, 0, -1, 0, 1), False),
        ((1, 0, 0.8, 1, 0.8, 1), False),
        ((0, 0, 0, 0, 0, 0), False),
    ],
)
def test_positive_definite(covariance, expected):
    assert is_positive_definite(Covariance(*covariance)) is expected
    assert bool((np.linalg.eigvalsh(matrix(covariance)) > 1e-12).all()) is expected
