"""Sun and shade: known solstices, and shadows by hand."""

from __future__ import annotations

from datetime import datetime, timezone
from math import degrees, pi, radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.simulation.shade import DIFFUSE, Obstacle, irradiance, light_factor, sunlit
from agv_motion.simulation.sun import Sun, sun


def at(*moment):
    return datetime(*moment, tzinfo=timezone.utc).timestamp()


@pytest.mark.parametrize(
    ('moment', 'elevation'),
    [((2015, 6, 21, 11, 52), 90.0 - 48.86 + 23.44), ((2015, 12, 22, 11, 49), 90.0 - 48.86 - 23.44)],
)
def test_noon_of_the_solstices_in_paris(moment, elevation):
    direction = sun(at(*moment), 48.86, 2.35)
    assert degrees(direction.elevation) == pytest.approx(elevation, abs=0.1)
    assert direction.azimuth == pytest.approx(-pi / 2, abs=0.02)  # south


def test_it_rises_in_the_east_and_is_gone_at_night():
    assert abs(sun(at(2015, 3, 20, 6, 0), 48.86, 2.35).azimuth) < radians(3.0)
    assert sun(at(2015, 6, 21, 0, 0), 48.86, 2.35).elevation < 0.0


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
    assert irradiance(12.0, 0.0, Sun(-0.1, 0.0), HOUSE) == 0.0


@given(st.floats(-30, 30), st.floats(-30, 30), st.floats(0.01, 1.5), st.floats(-pi, pi))
def test_light_is_a_share(x, y, elevation, azimuth):
    assert 0.0 <= sunlit(x, y, Sun(elevation, azimuth), HOUSE) <= 1.0
