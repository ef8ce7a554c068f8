"""Bearings and distances become places; what is none is named by its number."""

from __future__ import annotations

from math import inf, nan, pi

import pytest

from agv_motion.errors import GeometryError
from agv_motion.kinematics.polar_positions import polar_positions


def test_a_bearing_counts_from_the_x_axis():
    (ahead, left) = polar_positions('turret', [0.0, pi / 2], [2.0, 3.0])
    assert ahead == (2.0, 0.0)
    assert left == pytest.approx((0.0, 3.0), abs=1e-15)


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_a_place_that_is_none_is_named(bad):
    with pytest.raises(GeometryError, match=f'wheel 1 stands at {bad} rad, 1.0 m'):
        polar_positions('wheel', [0.0, bad], [1.0, 1.0])
    with pytest.raises(GeometryError, match=f'wheel 0 stands at 0.5 rad, {bad} m'):
        polar_positions('wheel', [0.5, 0.0], [bad, 1.0])


def test_a_bearing_without_distance_is_refused():
    with pytest.raises(GeometryError, match='2 angles and 1 distances: give both of every turret'):
        polar_positions('turret', [0.0, 1.0], [1.0])
