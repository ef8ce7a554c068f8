"""Places by angle and distance."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from agv_motion.errors import GeometryError
from agv_motion.kinematics.polar import polar_points


def test_angles_run_from_forward_to_the_left():
    points = polar_points([0.0, pi / 2, -pi / 4], [2.0, 1.0, sqrt(2.0)])
    assert [x for x, _ in points] == pytest.approx([2.0, 0.0, 1.0], abs=1e-15)
    assert [y for _, y in points] == pytest.approx([0.0, 1.0, -1.0], abs=1e-15)


def test_each_place_needs_both():
    with pytest.raises(GeometryError, match='2 angles and 3 distances'):
        polar_points([0.0, 1.0], [1.0, 1.0, 1.0])
