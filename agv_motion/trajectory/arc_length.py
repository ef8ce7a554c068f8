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
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import GeometryError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.trajectory.bezier import Column, CubicBezier

CHANGE_IN_A_CELL = 0.05
"""q of equation (1)."""

FIRST_CELLS = 64
"""Cells that a curve is cut into before equation (1) asks for more."""

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


class _Cell(NamedTuple):
    curve: CubicBezier
    start: float
    """[m] way at its start"""
    guess: list[float]
    """u over the way since the start: four coefficients"""
    first_u: float
    width: float
    """of u"""
    integral: list[float]
    """c_1 ... c_6 of equation (2) [m]"""


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
        self._cells: list[_Cell] = []
        self.length = 0.0
        for number, curve in enumerate(curves, 1):
            u = _nodes(curve, number)
            widths = np.diff(u)
            inside = u[:-1, None] + widths[:, None] * GAUSS_NODES
            speeds = widths[:, None] * np.abs(curve.velocity(inside))
            lengths, integral = speeds @ GAUSS_WEIGHTS, speeds @ INTEGRAL
            way = self.length + np.concatenate(([0.0], np.cumsum(lengths)))
            guess = _guess(u, lengths, np.abs(curve.velocity(u)))
            self._cells += map(
                _Cell, [curve] * len(widths), way[:-1].tolist(), guess.tolist(),
                u[:-1].tolist(), widths.tolist(), integral.tolist(),
            )  # fmt: skip
            self.length = float(way[-1])
            ways.append(way)
            curvatures.append(curve.curvature(u))
            sharpest = int(np.argmax(np.abs(curvatures[-1])))
            if abs(curvatures[-1][sharpest]) * (way[-1] - way[0]) > MOST_TURN:
                raise GeometryError(_cusp(number, float(u[sharpest])))
            middle_ways += [way[:-1] + integral @ HALF_POWERS, way[-1:]]
            middles += [curve.curvature(u[:-1] + 0.5 * widths), curvatures[-1][-1:]]
        self.way: Column = np.concatenate(ways)
        self.curvature: Column = np.concatenate(curvatures)
        self.middle_way: Column = np.concatenate(middle_ways[:-1])
        self.middle_curvature: Column = np.concatenate(middles[:-1])
        self._starts = [cell.start for cell in self._cells]

    def locate(self, way: float) -> tuple[CubicBezier, float]:
        """Return the curve and its parameter at ``way`` [m] from the start of the chain."""
        number = bisect_right(self._starts, way) - 1
        curve, start, (g0, g1, g2, g3), first, width, (c1, c2, c3, c4, c5, c6) = self._cells[number]
        rest = way - start
        u = g0 + rest * (g1 + rest * (g2 + rest * g3))
        x = (u - first) / width
        error = x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6))))) - rest
        return curve, u - error / abs(curve.velocity(u))


def _nodes(curve: CubicBezier, number: int) -> Column:
    """Return the parameters at the ends of the cells, after equation (1)."""
    u: Column = np.linspace(0.0, 1.0, FIRST_CELLS + 1)
    while True:
        velocity = curve.velocity(u)
        with np.errstate(all='ignore'):
            change = np.abs(velocity[1:] / velocity[:-1] - 1.0) / CHANGE_IN_A_CELL
        parts = np.ceil(np.clip(np.nan_to_num(change, nan=8.0), 1.0, 8.0)).astype(int)
        if parts.max() == 1:
            return u
        if parts.sum() > MOST_CELLS:
            raise GeometryError(_cusp(number, float(u[int(np.argmax(parts))])))
        widths = np.repeat(np.diff(u) / parts, parts)
        rank = np.arange(len(widths)) - np.repeat(np.cumsum(parts) - parts, parts)
        u = np.append(np.repeat(u[:-1], parts) + rank * widths, 1.0)


def _cusp(number: int, u: float) -> str:
    return (
        f'curve {number} has a cusp near {100.0 * u:.0f} % of its parameter, where a robot would '
        'have to turn about at once: give a larger delta_curve, or 0 to turn on the spot'
    )


def _guess(u: Column, lengths: Column, speed: Column) -> Column:
    """Return (n, 4) coefficients of the cubics u over the way, with slopes 1 / |P'|."""
    mean = np.diff(u) / lengths
    first, last = 1.0 / speed[:-1], 1.0 / speed[1:]
    square = (3.0 * mean - 2.0 * first - last) / lengths
    cube = (first + last - 2.0 * mean) / lengths**2
    return np.stack((u[:-1], first, square, cube), axis=1)
