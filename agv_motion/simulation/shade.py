"""Sun and shade over the zone: shadows of upright obstacles, wandering with the sun."""

from __future__ import annotations

from math import cos, hypot, sin, tan
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.sun import Sun

CLEAR_SKY = 1000.0
"""[W/m2] on a surface square to the sun, a round figure for a clear day at sea level."""

DIFFUSE = 0.3
"""Share of the light that comes from the whole sky and reaches the shade as well."""

PENUMBRA = 0.5
"""[m] width over which a shadow fades; keeps the light a continuous function of the place."""

LUX_PER_WATT = 120.0
"""[lx m2/W] luminous efficacy of daylight, about."""


class Obstacle(NamedTuple):
    """Something upright that throws a shadow: a house, a wall, another tree."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    radius: float
    """[m]"""
    height: float
    """[m]"""


def sunlit(x: float, y: float, sun: Sun, obstacles: Sequence[Obstacle]) -> float:
    """Return the share of direct sun that reaches the ground at (x, y): 1 in the sun, 0 in shade.

    The shadow of an obstacle is the strip of its width from its foot away from the sun, of length
    height / tan(elevation).
    """
    if sun.elevation <= 0.0:
        return 0.0
    away_x, away_y = -cos(sun.azimuth), -sin(sun.azimuth)
    light = 1.0
    for obstacle in obstacles:
        dx, dy = x - obstacle.x, y - obstacle.y
        length = obstacle.height / tan(sun.elevation)
        along = min(max(dx * away_x + dy * away_y, 0.0), length)
        distance = hypot(dx - along * away_x, dy - along * away_y) - obstacle.radius
        light = min(light, max(distance / PENUMBRA + 0.5, 0.0))
    return light


def irradiance(x: float, y: float, sun: Sun, obstacles: Sequence[Obstacle]) -> float:
    """Return the light on level ground at (x, y) under a clear sky [W/m2]."""
    if sun.elevation <= 0.0:
        return 0.0
    direct = (1.0 - DIFFUSE) * sunlit(x, y, sun, obstacles)
    return CLEAR_SKY * sin(sun.elevation) * (direct + DIFFUSE)


def light_factor(x: float, y: float, sun: Sun, obstacles: Sequence[Obstacle]) -> float:
    """Return the light at (x, y) as a share of that in the open: 1 in the sun, 0.3 in shade."""
    return DIFFUSE + (1.0 - DIFFUSE) * (sunlit(x, y, sun, obstacles) if sun.elevation > 0 else 1.0)
