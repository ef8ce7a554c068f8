"""SE(2): the axioms of a group, exact arcs, and the doors against NaN."""

from __future__ import annotations

from math import inf, nan, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.planar import (
    FASTEST,
    Pose,
    Twist,
    compose,
    exponential,
    integrate,
    inverse,
    logarithm,
    require_finite,
    require_twist,
    without_minus_zero,
    wrap,
)

NUMBER = st.floats(-10.0, 10.0)
POSES = st.builds(Pose, NUMBER, NUMBER, st.floats(-pi, pi, exclude_max=True))
TWISTS = st.builds(Twist, NUMBER, NUMBER, st.floats(-3.0, 3.0))
ORIGIN = Pose(0.0, 0.0, 0.0)


def close(pose, other, tolerance=1e-12):
    return (
        abs(pose.x - other.x) < tolerance
        and abs(pose.y - other.y) < tolerance
        and abs(wrap(pose.theta - other.theta)) < tolerance
    )


@given(st.floats(-1e6, 1e6))
def test_wrap_stays_in_the_half_open_interval(angle):
    assert -pi <= wrap(angle) < pi
    assert np.exp(1j * wrap(angle)) == pytest.approx(np.exp(1j * angle), abs=1e-9)


def test_wrap_at_the_seam():
    assert wrap(pi) == -pi
    assert wrap(-pi) == -pi
    assert -pi <= wrap(-pi - 1e-16) < pi
    assert -pi <= wrap(-1e-17 - pi) < pi


@given(POSES, POSES, POSES)
def test_composition_is_associative(a, b, c):
    assert close(compose(compose(a, b), c), compose(a, compose(b, c)), 1e-11)


@given(POSES)
def test_inverse_undoes(pose):
    assert close(compose(pose, inverse(pose)), ORIGIN, 1e-11)
    assert close(compose(inverse(pose), pose), ORIGIN, 1e-11)


@given(TWISTS)
def test_logarithm_undoes_exponential(twist):
    assert logarithm(exponential(twist)) == pytest.approx(twist, abs=1e-9)


@given(TWISTS, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_one_parameter_subgroup(twist, s, t):
    """Moving for s then for t is moving for s + t: no step size changes where an arc ends."""
    both = compose(exponential(twist, s), exponential(twist, t))
    assert close(both, exponential(twist, s + t), 1e-11)


@given(TWISTS.filter(lambda twist: abs(twist.wz) > 1e-6))
def test_the_series_of_small_angles_meets_the_closed_form(twist):
    """A quarter circle walked in 2**16 steps below the threshold of the series."""
    small = Twist(twist.vx, twist.vy, 0.9e-4)
    halves = compose(exponential(small, 0.5), exponential(small, 0.5))
    assert close(halves, exponential(small, 1.0), 1e-13 * 20)
    assert close(exponential(small, 1.2), integrate(exponential(small, 0.9), small, 0.3), 1e-11)


def test_a_quarter_circle():
    """Hand calculation: radius 2, a quarter turn to the left ends at (2, 2) facing left."""
    assert close(exponential(Twist(pi, 0.0, pi / 2)), Pose(2.0, 2.0, pi / 2), 1e-15 * 4)


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_not_finite_is_named(bad):
    with pytest.raises(SignalError, match='pose must be finite, got'):
        require_finite('pose', (0.0, bad, 1.0))


def test_large_finite_numbers_pass():
    require_finite('pose', (1e308, 1e308, -1e308))


def test_no_zero_has_a_minus():
    assert str(without_minus_zero(Twist(-0.0, 0.0, -0.0))) == str(Twist(0.0, 0.0, 0.0))
    assert without_minus_zero(Twist(-0.5, 1e-300, -1e-300)) == Twist(-0.5, 1e-300, -1e-300)


@pytest.mark.parametrize('bad', [nan, inf, -inf, 1.001 * FASTEST, -1e308])
def test_a_twist_that_nobody_can_mean_is_refused(bad):
    for part in range(3):
        with pytest.raises(SignalError, match=r'must be finite|at most 1000 m/s and rad/s'):
            require_twist(Twist(*(bad if i == part else 0.0 for i in range(3))))
    require_twist(Twist(FASTEST, -FASTEST, FASTEST))
