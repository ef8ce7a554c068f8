r"""Cubic Bezier curves that join two poses; points of the plane as complex numbers x + iy.

Control points of the curve from :math:`P_0` to :math:`P_3` with unit tangents :math:`t_0, t_3`:

.. math:: P_1 = P_0 + m t_0, \qquad P_2 = P_3 - m t_3, \qquad m = \delta\,|P_3 - P_0|   \tag{1}

and with :math:`c = P_3 - P_0`, in powers of the parameter :math:`u \in [0, 1]`,

.. math:: P(u) = P_0 + 3 m t_0\, u + 3 (c - m t_3 - 2 m t_0)\, u^2
    + (3 m t_0 + 3 m t_3 - 2 c)\, u^3   \tag{2}

The parameter has no meaning in time; `arc_length` measures the way along the curve.

Source: G. Farin, "Curves and Surfaces for CAGD", 5th ed., 2002, chapters 4 and 11.
"""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.planar import Pose

Column = NDArray[np.float64]
Numbers = NDArray[np.intp]
ComplexColumn = NDArray[np.complexfloating[Any, Any]]


class CubicBezier:
    """One curve, by the coefficients of its powers; every method takes a float or a column."""

    def __init__(self, start: complex, end: complex, leaving: complex, arriving: complex) -> None:
        """Keep the coefficients of equation (2).

        The powers are relative to ``start``, so a map far from its origin costs no digits.

        Args:
            start: P0 [m].
            end: P3 [m].
            leaving: P1 - P0 [m].
            arriving: P3 - P2 [m].

        """
        chord = end - start
        self.start = start
        self.end = end
        self.powers: tuple[Any, Any, Any] = (
            3.0 * leaving,
            3.0 * (chord - arriving - 2.0 * leaving),
            3.0 * (leaving + arriving) - 2.0 * chord,
        )
        """Coefficients of u, its square and its cube [m]"""

    @classmethod
    def column(cls, curves: Sequence[CubicBezier], which: Numbers) -> CubicBezier:
        """Return ``curves[which]`` as one, to be asked with a column of parameters of that shape.

        Only its derivatives can be asked for.
        """
        column = cls(0j, 0j, 0j, 0j)
        powers = np.array([curve.powers for curve in curves])
        column.powers = powers[which, 0], powers[which, 1], powers[which, 2]
        return column

    @overload
    def point(self, u: float) -> complex: ...
    @overload
    def point(self, u: Column) -> ComplexColumn: ...
    def point(self, u: float | Column) -> complex | ComplexColumn:
        """Return P(u) [m]."""
        linear, square, cube = self.powers
        point: complex | ComplexColumn = self.start + u * (linear + u * (square + u * cube))
        return point

    @overload
    def velocity(self, u: float) -> complex: ...
    @overload
    def velocity(self, u: Column) -> ComplexColumn: ...
    def velocity(self, u: float | Column) -> complex | ComplexColumn:
        """Return dP/du [m]: the hodograph."""
        linear, square, cube = self.powers
        velocity: complex | ComplexColumn = linear + u * (2.0 * square + u * (3.0 * cube))
        return velocity

    @overload
    def acceleration(self, u: float) -> complex: ...
    @overload
    def acceleration(self, u: Column) -> ComplexColumn: ...
    def acceleration(self, u: float | Column) -> complex | ComplexColumn:
        """Return d2P/du2 [m]."""
        _, square, cube = self.powers
        acceleration: complex | ComplexColumn = 2.0 * square + u * (6.0 * cube)
        return acceleration

    def curvature(self, u: Column) -> Column:
        r"""Return the curvature :math:`P' \times P'' / |P'|^3` [1/m], left positive."""
        velocity = self.velocity(u)
        square = velocity.real**2 + velocity.imag**2
        bend = self.acceleration(u)
        cross = velocity.real * bend.imag - velocity.imag * bend.real
        return np.asarray(cross / (square * np.sqrt(square)))


def connect(start: Pose, end: Pose, delta_curve: float, *, backward: bool = False) -> CubicBezier:
    """Return the curve of equation (1) between two poses.

    A robot that drives backwards looks against its way, so both tangents flip.

    Args:
        start: Where the curve leaves along the heading.
        end: Where it arrives along the heading.
        delta_curve: Length of the two handles, as a share of the distance.
        backward: Whether the robot drives backwards.

    """
    first, last = complex(start.x, start.y), complex(end.x, end.y)
    handle = (-delta_curve if backward else delta_curve) * abs(last - first)
    return CubicBezier(first, last, cmath.rect(handle, start.theta), cmath.rect(handle, end.theta))
