"""Laws of rotations, and of transforms in the plane."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.model.transform import planar, product, roll_pitch_yaw, rotated, turn
from agv_motion.planar import Pose

angles = st.floats(-10.0, 10.0)
three = st.tuples(angles, angles, angles)


def matrix(rotation):
    """Return what a rotation does to the three axes, as columns."""
    return np.array([rotated(rotation, axis) for axis in np.eye(3).tolist()]).T


def about(axis, angle):
    """Return the matrix of a rotation about x, y or z, as written in any textbook."""
    c, s = cos(angle), sin(angle)
    return np.array(
        {
            'x': [[1, 0, 0], [0, c, -s], [0, s, c]],
            'y': [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            'z': [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis]
    )


@given(three)
def test_roll_pitch_yaw_turns_about_the_fixed_axes_x_then_y_then_z(rpy):
    expected = about('z', rpy[2]) @ about('y', rpy[1]) @ about('x', rpy[0])
    np.testing.assert_allclose(matrix(roll_pitch_yaw(rpy)), expected, atol=1e-12)


@given(three, three, three)
def test_a_product_turns_as_one_after_the_other(first, second, vector):
    a, b = roll_pitch_yaw(first), roll_pitch_yaw(second)
    np.testing.assert_allclose(rotated(product(a, b), vector), rotated(a, rotated(b, vector)),
                               atol=1e-9)  # fmt: skip


def test_a_quarter_turn_about_z_takes_x_to_y():
    assert rotated(turn((0.0, 0.0, 1.0), pi / 2), (1.0, 0.0, 0.0)) == pytest.approx((0, 1, 0))


@pytest.mark.parametrize('turns', [1, 7, 1_000_000])
def test_whole_turns_change_nothing(turns):
    x, y, z, w = turn((0.0, 1.0, 0.0), 0.5 + 2 * pi * turns)
    sign = 1.0 if w > 0 else -1.0
    assert (sign * x, sign * y, sign * z, sign * w) == pytest.approx(
        (0.0, sin(0.25), 0.0, cos(0.25)), abs=1e-8
    )


def test_a_pose_in_the_plane_is_a_transform_on_the_floor():
    told = planar(3, 'map', 'odom', Pose(1.0, 2.0, pi / 2))
    assert told[:4] == (3, 'map', 'odom', (1.0, 2.0, 0.0))
    assert told.rotation == pytest.approx((0.0, 0.0, sin(pi / 4), cos(pi / 4)))
