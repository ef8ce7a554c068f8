r"""Way along a chain of curves, and its inverse: from metres back to the curve parameter.

The parameter is cut into cells within which the hodograph :math:`P'(u)` hardly changes,

.. math:: |P'(u_{i+1}) / P'(u_i) - 1| \le q   \tag{1}

which bounds the turn and the change of parameter speed together. In a cell :math:`|P'|` is
interpolated through Gauss-Legendre nodes; the integral of the interpolant,

.. math:: s(x) = s_i + \sum_{k=1}^{6} c_k x^k, \qquad x = \frac{u - u_i}{u_{i+1} - u_i}
    \tag{2}

is the Gauss-Legendre sum at :math:`x = 1` and within 1e-12 of the length of the chain between.
To invert it, the cubic through the ends with the true slopes :math:`du/ds = 1/|P'|` is a guess
good to 1e-6 of the cell, and one Newton step on (2) squares that error.

Source: B. Guenter, R. Parent, "Computing the arc length of parametric curves", IEEE Computer
Graphics and Applications 10(3), 1990 (adaptive Gaussian quadrature, table, Newton).
"""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.trajectory.bezier import Column, ComplexColumn, CubicBezier

CHANGE_IN_A_CELL = 0.05
"""q of equation (1)."""

FIRST_CELLS = 64
"""Cells that a curve is cut into before equation (1) asks for more."""

FIRST_NODES = np.linspace(0.0, 1.0, FIRST_CELLS + 1)

MOST_CELLS = 4000
"""A curve that needs more comes to rest within itself: it has a cusp."""

MOST_TURN = 1e6
"""Curvature times length above which a bend is as good as a cusp."""

GAUSS_NODES, GAUSS_WEIGHTS = np.array([[0.5], [0.0]]) + 0.5 * np.array(
    np.polynomial.legendre.leggauss(6)
)
"""On [0, 1]."""

INTEGRAL = np.linalg.inv(np.vander(GAUSS_NODES, increasing=True)).T / np.arange(1.0, 7.0)
"""Values at the nodes -> coefficients of x ... x**6 of the integral of their interpolant."""

HALF_POWERS = 0.5 ** np.arange(1.0, 7.0)


Cell = tuple[float, list[float], float, float, list[float]]
"""Way at its start [m]; four coefficients of u over the way since then; u at its start; its width
in u; c_1 ... c_6 of equation (2) [m]."""


class ArcLength:
    """The table of a chain of curves: parameter and curvature over the way.

    Attributes:
        way: (n,) way at each node [m], not decreasing; at a joint of two curves it stands twice.
        curvature: (n,) [1/m] at each node, left positive.
        middle_way: (n - 1,) way in the middle of the parameter of each cell [m].
        middle_curvature: (n - 1,) [1/m] there.
        length: Of the whole chain [m].

    """

    def __init__(self, curves: Sequence[CubicBezier]) -> None:
        """Measure ``curves``, which must follow each other.

        Raises:
            GeometryError: A curve has a cusp, where a robot would have to turn about at once.

        """
        ways, curvatures, middle_ways, middles = [], [], [], []
        self._curves: list[CubicBezier] = []  # of each cell
        self._cells: list[Cell] = []
        self.length = 0.0
        for number, curve in enumerate(curves, 1):
            u, speed = _nodes(curve, number)
            first, widths = u[:-1], u[1:] - u[:-1]
            inside = first[:, None] + widths[:, None] * GAUSS_NODES
            speeds = widths[:, None] * _length(curve.velocity(inside))
            lengths, integral = speeds @ GAUSS_WEIGHTS, speeds @ INTEGRAL
            way = np.empty(len(u))
            way[0] = self.length
            np.cumsum(lengths, out=way[1:])
            way[1:] += self.length
            self._curves += [curve] * len(widths)
            self._cells += zip(
                way[:-1].tolist(), _guess(first, widths, lengths, speed).tolist(),
                first.tolist(), widths.tolist(), integral.tolist(), strict=True,
            )  # fmt: skip
            self.length = float(way[-1])
            ways.append(way)
            curvature = curve.curvature(np.concatenate((u, first + 0.5 * widths)))
            curvature, middle = curvature[: len(u)], curvature[len(u) :]
            curvatures.append(curvature)
            sharpest = int(np.abs(curvature).argmax())
            if abs(curvature[sharpest]) * (way[-1] - way[0]) > MOST_TURN:
                raise GeometryError(_cusp(number, float(u[sharpest])))
            middle_ways += [way[:-1] + integral @ HALF_POWERS, way[-1:]]
            middles += [middle, curvature[-1:]]
        self.way: Column = np.concatenate(ways)
        self.curvature: Column = np.concatenate(curvatures)
        self.middle_way: Column = np.concatenate(middle_ways[:-1])
        self.middle_curvature: Column = np.concatenate(middles[:-1])
        self._starts = [cell[0] for cell in self._cells]

    def locate(self, way: float) -> tuple[CubicBezier, float]:
        """Return the curve and its parameter at ``way`` [m] from the start of the chain."""
        number = bisect_right(self._starts, way) - 1
        curve = self._curves[number]
        start, (g0, g1, g2, g3), first, width, (c1, c2, c3, c4, c5, c6) = self._cells[number]
        rest = way - start
        u = g0 + rest * (g1 + rest * (g2 + rest * g3))
        x = (u - first) / width
        error = x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6))))) - rest
        return curve, u - error / abs(curve.velocity(u))


def _nodes(curve: CubicBezier, number: int) -> tuple[Column, Column]:
    """Return the parameters at the ends of the cells, after equation (1), and |P'| there."""
    u = FIRST_NODES
    while True:
        velocity = curve.velocity(u)
        with np.errstate(all='ignore'):
            change = _length(velocity[1:] / velocity[:-1] - 1.0)
        if change.max() <= CHANGE_IN_A_CELL:  # not so where one is NaN
            return u, _length(velocity)
        change /= CHANGE_IN_A_CELL
        parts = np.ceil(np.clip(np.nan_to_num(change, nan=8.0), 1.0, 8.0)).astype(int)
        if parts.sum() > MOST_CELLS:
            raise GeometryError(_cusp(number, float(u[int(np.argmax(parts))])))
        widths = np.repeat((u[1:] - u[:-1]) / parts, parts)
        rank = np.arange(len(widths)) - np.repeat(np.cumsum(parts) - parts, parts)
        u = np.append(np.repeat(u[:-1], parts) + rank * widths, 1.0)


def _cusp(number: int, u: float) -> str:
    return (
        f'curve {number} has a cusp near {100.0 * u:.0f} % of its parameter, where a robot would '
        'have to turn about at once: give a larger delta_curve, or 0 to turn on the spot'
    )


def _guess(u: Column, widths: Column, lengths: Column, speed: Column) -> Column:
    """Return (n, 4) coefficients of the cubics u over the way, with slopes 1 / |P'|."""
    slope, mean = 1.0 / speed, widths / lengths
    first, last = slope[:-1], slope[1:]
    guess: Column = np.empty((len(u), 4))
    guess[:, 0] = u
    guess[:, 1] = first
    guess[:, 2] = (3.0 * mean - 2.0 * first - last) / lengths
    guess[:, 3] = (first + last - 2.0 * mean) / (lengths * lengths)
    return guess


def _length(vectors: ComplexColumn) -> Column:
    """Return the absolute values; numpy's own are safe against overflow, and slow."""
    length: Column = np.sqrt(vectors.real**2 + vectors.imag**2)
    return length
