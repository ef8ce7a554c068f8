"""Some of the wheels tell the twist; what they say beyond it is what no twist explains."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from agv_motion.errors import GeometryError
from agv_motion.kinematics.wheel_solution import solve_wheels

FOUR = [(1.0, -1.0, -0.5), (1.0, 1.0, 0.5), (1.0, 1.0, -0.5), (1.0, -1.0, 0.5)]
"""Mecanum wheels at (+-0.3, +-0.2): V = vx -+ vy -+ (0.3 + 0.2) wz."""
PLACES = [0.3 + 0.2j, 0.3 - 0.2j, -0.3 + 0.2j, -0.3 - 0.2j]


def test_four_wheels_by_hand():
    """Columns are square to each other: each is divided by its square, 4, 4 and 1."""
    found = solve_wheels(FOUR, PLACES, range(4))
    assert np.array(found.rows) == pytest.approx(np.array(FOUR) / (4.0, 4.0, 1.0), abs=1e-15)
    ((check,), count) = found.checks, found.wheels
    assert count == 4
    assert [c / check[0] for c in check] == pytest.approx([1.0, 1.0, -1.0, -1.0])
    assert sqrt(sum(c * c for c in check)) == pytest.approx(1.0)


def test_without_one_wheel_the_rest_tell_it_and_explain_all():
    found = solve_wheels(FOUR, PLACES, (0, 1, 3))
    assert found.rows[2] == (0.0, 0.0, 0.0)
    assert np.array(found.rows).T @ np.array(FOUR) == pytest.approx(np.eye(3), abs=1e-15)
    assert (found.checks, found.wheels) == ((), 3)


def test_what_no_wheel_feels_is_named():
    with pytest.raises(GeometryError, match=r'2 wheel\(s\) cannot tell a twist: at least 3'):
        solve_wheels(FOUR, PLACES, (0, 1))
    ahead = [(1.0, 0.0, 0.0), (1.0, 0.0, -0.5), (1.0, 0.0, 0.5)]
    with pytest.raises(GeometryError, match=r'no wheel turns when the base moves along \(0, 1\)'):
        solve_wheels(ahead, [0j, 0.5j, -0.5j], range(3))
    round_it = [(1.0, 0.0, 0.0), (0.0, 1.0, 2.0), (1.0, 1.0, 2.0)]
    with pytest.raises(GeometryError, match=r'rotates about \(2, 0\) m'):
        solve_wheels(round_it, [0j, 2.0 + 0j, 2.0 + 0j], range(3))
