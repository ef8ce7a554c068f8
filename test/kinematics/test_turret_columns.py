"""The batch path says what the scalar path says, row by row."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.kinematics import turret_columns as module
from agv_motion.kinematics.turret_columns import command_columns, polar_to_cartesian, twist_columns
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Twist

TREE = Turrets([(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)])


def rowwise(rows, held, limit):
    """Return the commands of the scalar path, each row holding the angles of the one before."""
    for row in rows:
        command = TREE.command(Twist(*row), held, limit)
        held = command.angle
        yield command


@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 7, 64]), st.floats(0.1, 2.0))
def test_columns_equal_rows(seed, block, limit):
    rng = np.random.default_rng(seed)
    rows = rng.uniform(-1, 1, (50, 3)) * (rng.random((50, 1)) > 0.3)
    held = list(rng.uniform(-3, 3, 3))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, 'BLOCK', block)
        columns = command_columns(TREE, tuple(rows.T), held, limit)
    commands = list(rowwise(rows, held, limit))
    np.testing.assert_allclose(columns.angle.T, [c.angle for c in commands], atol=1e-14)
    np.testing.assert_allclose(columns.speed.T, [c.speed for c in commands], atol=1e-14)


def test_memory_can_be_used_again():
    ones = np.ones(5)
    first = command_columns(TREE, (ones, ones, ones))
    again = command_columns(TREE, (ones, 0 * ones, 0 * ones), out=first)
    assert again.speed is first.speed
    np.testing.assert_array_equal(again.speed, 1.0)
    with pytest.raises(SignalError, match='out has shape'):
        command_columns(TREE, (ones[:3], ones[:3], ones[:3]), out=first)
    for mixed in (first._replace(angle=np.empty((3, 4))), first._replace(speed=np.empty((3, 4)))):
        with pytest.raises(SignalError, match=r'this call needs \(3, 5\): leave it out'):
            command_columns(TREE, (ones, ones, ones), out=mixed)


@given(st.floats(0, 1), st.floats(-pi, pi - 1e-9))
def test_polar_to_cartesian(v, theta):
    x, y = polar_to_cartesian(np.array([v]), np.array([theta]))
    assert x[0] == pytest.approx(v * cos(theta), abs=1e-14)
    assert y[0] == pytest.approx(v * sin(theta), abs=1e-14)


def test_a_bad_row_is_named():
    column = np.zeros(module.BLOCK + 10)
    bad = column.copy()
    bad[module.BLOCK + 3] = np.nan
    with pytest.raises(SignalError, match=f'row {module.BLOCK + 3}'):
        command_columns(TREE, (column, bad, column))
    with pytest.raises(SignalError, match='shapes'):
        command_columns(TREE, (column, column[1:], column))


def test_no_rows_are_no_rows():
    nothing = np.zeros(0)
    assert command_columns(TREE, (nothing, nothing, nothing)).angle.shape == (3, 0)


def test_the_twist_of_columns_is_that_of_rows():
    rng = np.random.default_rng(2)
    angles, speeds = rng.uniform(-3, 3, (3, 20)), rng.uniform(-1, 1, (3, 20))
    found = twist_columns(TREE, angles, speeds)
    for i, (angle, speed) in enumerate(zip(angles.T, speeds.T, strict=True)):
        fit = TREE.twist(list(angle), list(speed))
        assert (tuple(found.twist[:, i]), found.residual[i]) == (fit.twist, fit.residual)


def test_measured_columns_must_fit_the_platform():
    zeros = np.zeros((3, 4))
    with pytest.raises(SignalError, match=r'angles columns have shape \(2, 4\)'):
        twist_columns(TREE, zeros[:2], zeros)
    with pytest.raises(SignalError, match='4 rows of angles and 3 of speeds'):
        twist_columns(TREE, zeros, zeros[:, :3])
    with pytest.raises(SignalError, match='3 held angles for 2 turrets'):
        command_columns(Turrets([(1.0, 0.0), (-1.0, 0.0)]), zeros, [0.0] * 3)


def test_angles_that_are_held_are_finite():
    with pytest.raises(SignalError, match='held_angles must be finite'):
        command_columns(TREE, np.zeros((3, 4)), [0.0, np.nan, 0.0])
