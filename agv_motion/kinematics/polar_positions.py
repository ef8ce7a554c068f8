"""Where turrets or wheels stand that are given by bearing and distance."""

from __future__ import annotations

from math import cos, isfinite, sin
from typing import TYPE_CHECKING

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from collections.abc import Sequence


def polar_positions(
    what: str, angles: Sequence[float], distances: Sequence[float]
) -> list[tuple[float, float]]:
    """Return the x and y [m] of what stands at polar positions from the centre of the base frame.

    Args:
        what: Stands there, in a word.
        angles: (n,) from the x axis [rad].
        distances: (n,) from the centre [m].

    Raises:
        GeometryError: The lengths differ, or a number is not finite.

    """
    if len(angles) != len(distances):
        msg = f'{len(angles)} angles and {len(distances)} distances: give both of every {what}'
        raise GeometryError(msg)
    for number, (angle, distance) in enumerate(zip(angles, distances, strict=True)):
        if not (isfinite(angle) and isfinite(distance)):
            msg = f'{what} {number} stands at {angle} rad, {distance} m: give finite numbers'
            raise GeometryError(msg)
    return [(d * cos(a), d * sin(a)) for a, d in zip(angles, distances, strict=True)]
