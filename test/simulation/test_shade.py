"""Shadows by hand, and light as a share."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.simulation.shade import DIFFUSE, Obstacle, irradiance, light_factor, sunlit
from agv_motion.sun import Sun

HOUSE = [Obstacle(0.0, 0.0, 1.0, 10.0)]
EVENING = Sun(pi / 4, pi)  # in the west, at 45 degrees: shadows as long as things are high


@pytest.mark.parametrize(
    ('x', 'y', 'light'),
    [(5.0, 0.0, 0.0), (9.0, 0.9, 0.2), (12.0, 0.0, 1.0), (-2.0, 0.0, 1.0), (5.0, 2.0, 1.0)],
)
def test_a_shadow_by_hand(x, y, light):
    """Ten metres long, two wide, to the east; half light on its edge, 0.5 m to fade."""
    expected = 0.3 if light == 0.2 else light  # (0.9 - 1.0) / 0.5 + 0.5
    assert sunlit(x, y, EVENING, HOUSE) == pytest.approx(expected)


def test_light_in_shade_and_sun():
    assert light_factor(12.0, 0.0, EVENING, HOUSE) == 1.0
    assert light_factor(5.0, 0.0, EVENING, HOUSE) == DIFFUSE
    assert irradiance(12.0, 0.0, EVENING, HOUSE) == pytest.approx(1000.0 * 0.5**0.5)
    assert irradiance(5.0, 0.0, EVENING, HOUSE) == pytest.approx(300.0 * 0.5**0.5)
    for elevation in (-0.1, 0.0):
        night = Sun(elevation, pi)
        assert irradiance(12.0, 0.0, night, HOUSE) == sunlit(12.0, 0.0, night, HOUSE) == 0.0
        assert light_factor(5.0, 0.0, night, HOUSE) == 1.0
    two = [*HOUSE, Obstacle(9.0, 1.2, 1.0, 10.0)]
    assert sunlit(9.0, 0.9, EVENING, two) == sunlit(9.0, 0.9, EVENING, two[::-1]) == 0.0


@given(st.floats(-30, 30), st.floats(-30, 30), st.floats(0.01, 1.5), st.floats(-pi, pi))
def test_light_is_a_share(x, y, elevation, azimuth):
    assert 0.0 <= sunlit(x, y, Sun(elevation, azimuth), HOUSE) <= 1.0
