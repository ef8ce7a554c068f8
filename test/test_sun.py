"""Where the sun stands: known solstices, and where it rises and sets."""

from __future__ import annotations

from datetime import datetime, timezone
from math import degrees, pi, radians

import pytest

from agv_motion.sun import half_day, solar_time, sun


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


def test_it_sets_in_the_west_and_moves_by_a_quarter_hour_a_degree():
    """At 6 h of true time it stands in the west; an hour is 15 degrees at the equator."""
    evening = sun(at(2015, 3, 20, 18, 7), 0.0, 0.0)
    assert abs(evening.azimuth) == pytest.approx(pi, abs=0.02)
    before = sun(at(2015, 3, 20, 17, 7), 0.0, 0.0)
    assert degrees(before.elevation - evening.elevation) == pytest.approx(15.0, abs=0.1)


def test_further_east_it_is_later():
    """Fifteen degrees of longitude are an hour, but for what the sun moves meanwhile."""
    here, there = sun(at(2015, 6, 21, 9, 0), 48.0, 15.0), sun(at(2015, 6, 21, 10, 0), 48.0, 0.0)
    assert here == pytest.approx(there, abs=1e-3)


def test_at_the_pole_it_neither_rises_nor_sets():
    heights = [degrees(sun(at(2015, 6, 21, hour, 0), 90.0, 0.0).elevation) for hour in range(24)]
    assert heights == pytest.approx([23.44] * 24, abs=0.05)


@pytest.mark.parametrize(
    ('moment', 'minutes'),
    [((2015, 2, 11, 12, 0), -14.2), ((2015, 11, 3, 12, 0), 16.4), ((2015, 6, 13, 12, 0), 0.0)],
)
def test_noon_of_the_sun_is_early_or_late_by_the_equation_of_time(moment, minutes):
    assert degrees(solar_time(at(*moment), 0.0).hour_angle) * 4.0 == pytest.approx(minutes, abs=0.3)


@pytest.mark.parametrize(
    ('declination', 'latitude', 'hours'),
    [(0.0, 48.86, 6.0), (23.44, 48.86, 7.98), (-23.44, 48.86, 4.02), (23.44, 70.0, 12.0),
     (-23.44, 70.0, 0.0)],
)  # fmt: skip
def test_half_a_day_is_six_hours_at_the_equinox_and_longer_in_summer(declination, latitude, hours):
    found = half_day(radians(declination), latitude)
    assert found * 12.0 / pi == pytest.approx(hours, abs=0.01)


@pytest.mark.parametrize('latitude', [-40.0, 0.0, 48.86])
def test_the_sun_sets_at_the_end_of_half_a_day(latitude):
    start = at(2015, 4, 10, 12, 0)
    declination, angle = solar_time(start, 0.0)
    sunset = start + (half_day(declination, latitude) - angle) / (2.0 * pi) * 86400.0
    assert degrees(sun(sunset, latitude, 0.0).elevation) == pytest.approx(0.0, abs=0.15)
