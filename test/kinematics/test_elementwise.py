"""Columns of values by the functions of math, to the bit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from agv_motion.kinematics.elementwise import elementwise


@pytest.mark.parametrize('function', [math.sin, math.cos, math.exp])
def test_each_value_is_that_of_math_and_the_shape_stays(function):
    columns = np.random.default_rng(0).uniform(-10.0, 10.0, (3, 50))
    found = elementwise(function, columns)
    assert found.shape == columns.shape
    assert found.ravel().tolist() == [function(value) for value in columns.ravel().tolist()]


def test_no_values_are_none():
    assert elementwise(math.sin, np.zeros((2, 0))).shape == (2, 0)
