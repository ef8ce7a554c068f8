"""Nine of 36 numbers are those of x, y and yaw."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import Covariance
from agv_motion.ros.covariances import covariance_of, fill_covariance


@given(st.tuples(*[st.floats(-1e6, 1e6)] * 6))
def test_what_is_filled_in_is_read_and_is_symmetric(values):
    numbers = [0.0] * 36
    fill_covariance(numbers, Covariance(*values))
    assert covariance_of(numbers) == Covariance(*values)
    matrix = np.reshape(numbers, (6, 6))
    assert np.array_equal(matrix, matrix.T)
    assert not matrix[2:5].any()


def test_its_places_are_those_of_ros():
    numbers = [0.0] * 36
    fill_covariance(numbers, Covariance(1.0, 2.0, 3.0, 4.0, 5.0, 6.0))
    matrix = np.reshape(numbers, (6, 6))
    assert matrix[0, [0, 1, 5]].tolist() == [1.0, 2.0, 3.0]
    assert matrix[1, [1, 5]].tolist() == [4.0, 5.0]
    assert matrix[5, 5] == 6.0


def test_one_that_is_not_symmetric_or_not_finite_is_refused_by_its_place():
    numbers = [0.0] * 36
    numbers[5] = 0.1
    with pytest.raises(SignalError, match=r'covariance\[5\] = 0.1 and covariance\[30\] = 0.0'):
        covariance_of(numbers)
    numbers[5], numbers[35] = 0.0, nan
    with pytest.raises(SignalError, match='covariance of x, y and yaw'):
        covariance_of(numbers)
