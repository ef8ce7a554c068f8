"""The batch path says what the scalar path says, row by row."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.kinematics.omniwheel_columns import command_columns, twist_columns
from agv_motion.kinematics.omniwheel_placement import mecanum_wheels
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.planar import Twist

BASE = OmniWheels(mecanum_wheels(0.3, 0.2))


@given(st.integers(0, 2**32 - 1))
def test_columns_equal_rows(seed):
    rng = np.random.default_rng(seed)
    twist, speeds = rng.uniform(-1, 1, (3, 20)), rng.uniform(-1, 1, (4, 20))
    commanded = [BASE.command(Twist(*row)).speed for row in twist.T]
    np.testing.assert_allclose(command_columns(BASE, twist).T, commanded, atol=1e-14)
    columns, fits = (
        twist_columns(BASE, speeds),
        [BASE.twist(list(row)) for row in speeds.T],
    )
    np.testing.assert_allclose(columns.twist.T, [fit.twist for fit in fits], atol=1e-14)
    np.testing.assert_allclose(columns.residual, [fit.residual for fit in fits], atol=1e-14)


def test_a_bad_row_is_named():
    speeds = np.zeros((4, 9))
    speeds[2, 5] = np.nan
    with pytest.raises(SignalError, match='speeds columns are not finite at row 5'):
        twist_columns(BASE, speeds)
    with pytest.raises(SignalError, match=r'shape \(4, 9\), expected \(3, n\)'):
        command_columns(BASE, speeds)


def test_a_row_beyond_the_limit_is_scaled_as_a_whole():
    rng = np.random.default_rng(1)
    twist = rng.uniform(-1, 1, (3, 50))
    expected = [BASE.command(Twist(*row), 0.6).speed for row in twist.T]
    np.testing.assert_allclose(command_columns(BASE, twist, 0.6).T, expected, atol=1e-14)
