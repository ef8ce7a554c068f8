"""The direction of a twist: a unit vector in which the velocity of every wheel is linear.

Its parts are the velocity of the turrets' centroid, along x and y, and the rotation times the
turrets' mean distance from it. The centre of wheel i, at ``(x_i, y_i)`` from the centroid over that
distance, moves at ``(a - c y_i, b + c x_i)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, sqrt

Direction = tuple[float, float, float]

Arms = Sequence[tuple[float, float]]
"""(n,) turret centres from their centroid, over their mean distance from it"""

STILL: Direction = (0.0, 0.0, 0.0)
"""Velocity of a direction that rests; told by identity."""

POINT = 1e-9
"""[-] Relative wheel velocity below which the centre of rotation lies at the turret."""
POINT_SQUARED = POINT * POINT

START_ERROR = 0.17
"""[rad] A twist so near to the wanted one is corrected while rolling, so that noise of the wanted
twist cannot hold the platform at rest."""


NEAR = cos(START_ERROR)


def are_near(first: Direction, second: Direction) -> bool:
    """Return whether two directions lie within `START_ERROR`."""
    return first[0] * second[0] + first[1] * second[1] + first[2] * second[2] > NEAR


def bearings(arms: Arms, direction: Direction) -> list[float | None]:
    """Return (n,) the way in which each wheel moves [rad], None for one that does not."""
    a, b, c = direction
    moves = [(a - c * y, b + c * x) for x, y in arms]
    return [atan2(y, x) if x * x + y * y > POINT * POINT else None for x, y in moves]


def wheel_lengths(arms: Arms, direction: Direction) -> list[float]:
    """Return (n,) the speed of each wheel while the twist is ``direction`` times 1 m/s [m/s]."""
    a, b, c = direction
    return [sqrt((a - c * y) ** 2 + (b + c * x) ** 2) for x, y in arms]
