"""Dead reckoning: exact arcs, and a covariance that errors made on the way bear out."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.columns import adjoint_columns, matrix, noise_columns, pose_columns
from agv_motion.odometry.covariance import Covariance, rotate, shift
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.planar import Pose, Twist, integrate

LENGTH = st.floats(-3.0, 3.0)
WAYS = st.lists(st.tuples(LENGTH, LENGTH, st.floats(-2.0, 2.0)), min_size=1, max_size=20)
NOISE = Covariance(0.04, 0.01, 0.02, 0.09, -0.01, 0.16)


def close(pose, expected, tolerance):
    assert pose[:2] == pytest.approx(expected[:2], abs=tolerance)
    assert (pose[2] - expected[2] + pi) % (2 * pi) - pi == pytest.approx(0.0, abs=tolerance)


def test_a_quarter_circle_by_hand():
    """Hand calculation: a quarter of the circle of radius 2 m to the left ends at (2, 2)."""
    reckoning = DeadReckoning()
    reckoning.carry((pi, 0.0, pi / 2), NOISE)
    assert reckoning.pose == pytest.approx((2.0, 2.0, pi / 2), abs=1e-15)


@given(WAYS)
def test_each_step_is_the_exponential_of_its_twist(way):
    reckoning, expected = DeadReckoning(), Pose(0.0, 0.0, 0.0)
    for step in way:
        reckoning.carry(step, NOISE, 0.1)
        expected = integrate(expected, Twist(*step), 1.0)
    close(reckoning.pose, expected, 1e-11)


@given(st.tuples(LENGTH, LENGTH, st.floats(-6.0, 6.0)), st.integers(2, 9))
def test_the_end_of_an_arc_does_not_depend_on_the_steps(arc, parts):
    whole, piecewise = DeadReckoning(), DeadReckoning()
    whole.carry(arc, NOISE)
    for _ in range(parts):
        piecewise.carry(tuple(part / parts for part in arc), NOISE)
    close(piecewise.pose, whole.pose, 1e-12)


@given(WAYS)
def test_the_covariance_adds_up_about_the_origin(way):
    reckoning, expected = DeadReckoning(), np.zeros(6)
    for step in way:
        before = reckoning.pose
        reckoning.carry(step, NOISE, 0.1)
        after = reckoning.pose
        halfway = before.theta + step[2] / 2
        middle = (before.x + after.x) / 2, (before.y + after.y) / 2
        added = shift(rotate(NOISE, halfway), -middle[0], -middle[1])
        expected += 0.1 * np.array(added)
    np.testing.assert_allclose(reckoning.origin_covariance, expected, rtol=1e-9, atol=1e-9)


def test_the_covariance_is_that_of_a_thousand_noisy_runs():
    """A noisy square is driven again and again: the spread of its ends is the one told."""
    rng = np.random.default_rng(5)
    steps = np.array([(0.1, 0.0, 0.0)] * 20 + [(0.0, 0.0, pi / 20)] * 10)
    way = np.tile(steps, (4, 1)).T
    noise = Covariance(1e-5, 0.0, 2e-6, 4e-5, 0.0, 1e-5)
    told = DeadReckoning()
    for step in way.T:
        told.carry(tuple(step), noise)
    xx, xy, xt, yy, yt, tt = noise
    root = np.linalg.cholesky([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
    ends = np.array(
        [pose_columns(way + root @ rng.standard_normal(way.shape))[:, -1] for _ in range(4000)]
    )
    found = np.cov(ends.T)[np.triu_indices(3)]
    scale = np.sqrt(np.outer(*[np.array([told.covariance()[i] for i in (0, 3, 5)])] * 2))
    np.testing.assert_allclose(
        found / scale[np.triu_indices(3)],
        np.array(told.covariance()) / scale[np.triu_indices(3)],
        atol=0.06,
    )


@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(-3, 3))
def test_what_is_set_is_told(x, y, theta):
    reckoning = DeadReckoning()
    reckoning.set(Pose(x, y, theta), NOISE)
    assert reckoning.pose == pytest.approx((x, y, theta), abs=1e-15)
    assert reckoning.covariance() == pytest.approx(NOISE, abs=1e-11)


@given(WAYS, st.floats(-3, 3))
def test_columns_equal_steps(way, heading):
    reckoning, start = DeadReckoning(), Pose(1.0, 2.0, heading)
    reckoning.set(start)
    columns = pose_columns(np.array(way).T, start)
    close(columns[:, 0], start, 1e-15)
    for step, pose in zip(way, columns.T[1:], strict=True):
        reckoning.carry(step, NOISE)
        close(pose, reckoning.pose, 1e-11)


@given(WAYS)
def test_noise_by_columns_equals_that_of_steps(way):
    reckoning = DeadReckoning()
    adjoint = adjoint_columns(pose_columns(np.array(way).T))
    columns = noise_columns(adjoint, matrix(NOISE), 0.1 * np.arange(len(way)))
    assert not columns[0].any()
    for i, step in enumerate(way):
        reckoning.carry(step, NOISE, 0.1 * i)
        found = columns[i + 1][np.triu_indices(3)]
        np.testing.assert_allclose(found, reckoning.origin_covariance, rtol=1e-9, atol=1e-9)


@given(WAYS, st.floats(-3, 3))
def test_steps_carried_by_columns_are_those_carried_one_by_one(way, heading):
    singly, at_once = DeadReckoning(), DeadReckoning()
    for each in (singly, at_once):
        each.set(Pose(1.0, 2.0, heading), NOISE)
    variance = 0.1 * np.arange(len(way))
    poses, covariances = at_once.carry_columns(tuple(np.array(way).T), NOISE, variance)
    for i, step in enumerate(way):
        singly.carry(step, NOISE, float(variance[i]))
        assert singly.pose == tuple(column[i] for column in poses)
        assert singly.covariance() == tuple(column[i] for column in covariances)
    assert (at_once.pose, at_once.covariance()) == (singly.pose, singly.covariance())


def test_what_is_not_finite_is_refused():
    with pytest.raises(SignalError, match='pose must be finite'):
        DeadReckoning().set(Pose(0.0, float('nan'), 0.0))
    with pytest.raises(SignalError, match=r'shape \(2, 5\), expected \(3, n\)'):
        pose_columns(np.zeros((2, 5)))
    bad = np.zeros((3, 5))
    bad[1, 3] = np.inf
    with pytest.raises(SignalError, match='not finite at row 3'):
        pose_columns(bad)
