"""Where wheels stand whose places are given by angle and distance from the centre."""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from collections.abc import Sequence


def polar_points(angles: Sequence[float], distances: Sequence[float]) -> list[tuple[float, float]]:
    """Return the (n, 2) points [m] at polar positions in the base frame.

    Args:
        angles: (n,) from the x axis [rad].
        distances: (n,) from the centre [m].

    Raises:
        GeometryError: The lengths differ.

    """
    if len(angles) != len(distances):
        msg = f'{len(angles)} angles and {len(distances)} distances: give both of every wheel'
        raise GeometryError(msg)
    return [(d * cos(a), d * sin(a)) for a, d in zip(angles, distances, strict=True)]
