"""Whole recordings at once: the same as step by step."""

from __future__ import annotations

from math import nan, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.columns import adjoint_columns, matrix, noise_columns, pose_columns
from agv_motion.odometry.covariance import Covariance
from agv_motion.planar import Pose, Twist, integrate

small = st.floats(-2.0, 2.0)


def test_a_quarter_circle_by_hand():
    """A metre of radius to the left, from (1, 2) northwards: it ends at (0, 3), westwards."""
    x, y, heading = pose_columns([[pi / 2], [0.0], [pi / 2]], Pose(1.0, 2.0, pi / 2))
    assert x == pytest.approx([1.0, 0.0])
    assert y == pytest.approx([2.0, 3.0])
    assert heading == pytest.approx([pi / 2, pi])


@settings(max_examples=40)
@given(st.lists(st.tuples(small, small, small), max_size=6))
def test_columns_are_the_steps_one_by_one(steps):
    pose = Pose(0.3, -0.4, 0.5)
    found = pose_columns(np.array(steps).reshape(-1, 3).T, pose)
    for k, step in enumerate(steps, 1):
        pose = integrate(pose, Twist(*step), 1.0)
        assert found[:2, k] == pytest.approx(pose[:2], abs=1e-12)
        assert np.cos(found[2, k] - pose.theta) == pytest.approx(1.0)


def test_turns_are_counted():
    assert pose_columns([[0.0] * 3, [0.0] * 3, [3.0] * 3])[2] == pytest.approx([0, 3, 6, 9])


def test_what_is_no_column_is_refused_with_its_row():
    with pytest.raises(SignalError, match=r'shape \(2, 3\), expected \(3, n\)'):
        pose_columns(np.zeros((2, 3)))
    bad = np.zeros((3, 4))
    bad[1, 2] = nan
    with pytest.raises(SignalError, match='not finite at row 2: drop that row'):
        pose_columns(bad)


def test_a_covariance_as_a_matrix():
    found = matrix(Covariance(1, 2, 3, 4, 5, 6))
    assert found.tolist() == [[1, 2, 3], [2, 4, 5], [3, 5, 6]]


def test_noise_grows_by_what_each_step_adds_seen_from_the_origin():
    """At (0, 1) looking north: forward noise lies along y; a turn moves the origin along x."""
    poses = np.array([[0.0, 0.0], [1.0, 1.0], [pi / 2, pi / 2]])
    (adjoint,) = adjoint_columns(poses)
    assert adjoint @ [1.0, 0.0, 0.0] == pytest.approx([0.0, 1.0, 0.0])
    assert adjoint @ [0.0, 0.0, 1.0] == pytest.approx([1.0, 0.0, 1.0])
    found = noise_columns(adjoint_columns(poses), np.diag([4.0, 0.0, 1.0]), np.array([2.0]))
    assert found[0].tolist() == np.zeros((3, 3)).tolist()
    assert found[1] == pytest.approx(np.array([[2, 0, 2], [0, 8, 0], [2, 0, 2]]))
