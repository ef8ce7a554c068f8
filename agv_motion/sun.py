"""Where the sun stands, and how long the day is; good to a degree: enough for shadows on a square.

Source: J. J. Michalsky, "The Astronomical Almanac's algorithm for approximate solar position
(1950-2050)", Solar Energy 40(3), 1988; refraction left out.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, pi, radians, sin, tan, tau
from typing import NamedTuple

J2000 = 946_728_000.0
"""[s] 1 January 2000, 12:00 UTC, in seconds since 1970."""


class Sun(NamedTuple):
    """Direction of the sun seen from a place."""

    elevation: float
    """[rad] above the horizon; negative at night"""
    azimuth: float
    """[rad] counter-clockwise from east, as every heading here: map x is east, y is north"""


class SolarTime(NamedTuple):
    """The sun on a meridian."""

    declination: float
    """[rad] how far north of the equator it stands"""
    hour_angle: float
    """[rad] since it stood highest, in [-pi, pi)"""


def solar_time(time: float, longitude: float) -> SolarTime:
    """Return how the sun stands to the meridian of a place.

    Args:
        time: Seconds since 1970, UTC.
        longitude: [deg] east positive.

    """
    days = (time - J2000) / 86400.0
    mean_longitude = radians((280.460 + 0.9856474 * days) % 360.0)
    anomaly = radians((357.528 + 0.9856003 * days) % 360.0)
    ecliptic = mean_longitude + radians(1.915 * sin(anomaly) + 0.020 * sin(2.0 * anomaly))
    obliquity = radians(23.439 - 4e-7 * days)
    right_ascension = atan2(cos(obliquity) * sin(ecliptic), cos(ecliptic))
    sidereal = radians((280.46062 + 360.98564737 * days + longitude) % 360.0)
    return SolarTime(
        asin(sin(obliquity) * sin(ecliptic)), (sidereal - right_ascension + pi) % tau - pi
    )


def half_day(declination: float, latitude: float) -> float:
    """Return the hour angle of sunset [rad]: 0 where the sun never rises, pi where it never sets.

    Args:
        declination: Of the sun [rad].
        latitude: [deg] north positive.

    """
    return acos(min(max(-tan(radians(latitude)) * tan(declination), -1.0), 1.0))


def sun(time: float, latitude: float, longitude: float) -> Sun:
    """Return the direction of the sun.

    Args:
        time: Seconds since 1970, UTC.
        latitude: [deg] north positive.
        longitude: [deg] east positive.

    """
    declination, hour_angle = solar_time(time, longitude)
    phi = radians(latitude)
    east = -cos(declination) * sin(hour_angle)
    north = cos(phi) * sin(declination) - sin(phi) * cos(declination) * cos(hour_angle)
    up = sin(phi) * sin(declination) + cos(phi) * cos(declination) * cos(hour_angle)
    return Sun(asin(max(-1.0, min(1.0, up))), atan2(north, east))
