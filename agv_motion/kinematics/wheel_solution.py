"""The least-squares way back from the speeds of some of the wheels to the twist."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.kinematics.omniwheel_placement import Row

SINGULAR = 1e-6
"""[-] Ratio of the least to the greatest singular value below which a placement is refused."""


class WheelSolution(NamedTuple):
    """The pseudo-inverse of the matrix of some of the wheels, and what it cannot explain."""

    rows: tuple[Row, ...]
    """One a wheel: what 1 m/s at its rim adds to vx, vy, wz; zeros where the wheel is missing"""
    checks: tuple[tuple[float, ...], ...]
    """Orthonormal combinations of the wheel speeds that every twist leaves zero"""
    wheels: int
    """How many measure"""


def solve_wheels(
    driven: Sequence[Row], places: Sequence[complex], present: Sequence[int]
) -> WheelSolution:
    """Return how the wheels ``present`` tell the twist.

    Args:
        driven: (n,) rim speed of each wheel for unit vx, vy and wz.
        places: (n,) x + iy of each wheel [m].
        present: Numbers of those that measure.

    Raises:
        GeometryError: They are less than three, or some motion of the base turns none of them (the
            message names it).

    """
    if len(present) < 3:
        msg = f'{len(present)} wheel(s) cannot tell a twist: at least 3 are needed'
        raise GeometryError(msg)
    some = np.array(driven)[list(present)]
    reach = sqrt(float(np.mean([(p.real * p.real + p.imag * p.imag) for p in places]))) or 1.0
    left, values, right = np.linalg.svd(some / (1.0, 1.0, reach))  # all columns in m/s
    if values[-1] < SINGULAR * values[0]:
        missed = right[-1] / (1.0, 1.0, reach)
        msg = f'no wheel turns when the base {_motion(missed)}: turn or move a wheel'
        raise GeometryError(msg)
    rows, checks = np.zeros((len(places), 3)), np.zeros((len(present) - 3, len(places)))
    rows[list(present)] = np.linalg.pinv(some).T
    checks[:, list(present)] = left.T[3:]
    return WheelSolution(
        tuple((float(a), float(b), float(c)) for a, b, c in rows),
        tuple(tuple(map(float, check)) for check in checks),
        len(present),
    )


def _motion(twist: NDArray[np.float64]) -> str:
    """Return the motion of ``twist`` in words."""
    vx, vy, wz = map(float, twist)
    speed = sqrt(vx * vx + vy * vy)
    if abs(wz) < SINGULAR * speed:
        if vx < -SINGULAR * speed or (vx < SINGULAR * speed and vy < 0.0):
            vx, vy = -vx, -vy  # the sign that the decomposition gives depends on the processor
        return f'moves along ({vx / speed + 0.0:.4g}, {vy / speed + 0.0:.4g})'
    return f'rotates about ({-vy / wz + 0.0:.4g}, {vx / wz + 0.0:.4g}) m'
