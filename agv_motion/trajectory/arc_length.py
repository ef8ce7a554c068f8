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
from agv_motion.trajectory.bezier import CubicBezier

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.trajectory.bezier import Column, ComplexColumn, Numbers

CHANGE_IN_A_CELL = 0.05
"""q of equation (1)."""

FIRST_CELLS = 64
"""Cells that a curve is cut into before equation (1) asks for more."""

FIRST_CELLS_IN_ALL, FEWEST_FIRST = 512, 8
"""Of many curves each is cut into fewer at first."""

MOST_CELLS = 4000
"""A curve that needs more comes to rest within itself: it has a cusp."""

MOST_CELLS_IN_ALL = 20000
"""A chain that needs more takes too long to plan."""

LEAST = 1e-15
"""[-] Change of the way with the parameter, over the whole way, below which a curve stands."""

MOST_PARTS = 8
"""Into which a cell is cut at once."""

MOST_TURN = 1e6
"""Curvature times length above which a bend is as good as a cusp."""

GAUSS_NODES, GAUSS_WEIGHTS = np.array([[0.5], [0.0]]) + 0.5 * np.array(
    np.polynomial.legendre.leggauss(6)
)
"""On [0, 1]."""

INTEGRAL = np.linalg.inv(np.vander(GAUSS_NODES, increasing=True)).T / np.arange(1.0, 7.0)
"""Values at the nodes -> coefficients of x ... x**6 of the integral of their interpolant."""

HALF_POWERS = 0.5 ** np.arange(1.0, 7.0)


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
        which, u, widths = _cells(curves)
        numbers = np.arange(len(curves))
        ends = np.searchsorted(which, numbers, side='right')  # cells up to the end of each curve
        here, inner = CubicBezier.column(curves, which), np.arange(len(which)) + which
        speeds = widths[:, None] * _length(
            CubicBezier.column(curves, which[:, None]).velocity(
                u[:, None] + widths[:, None] * GAUSS_NODES
            )
        )
        lengths, integral = speeds @ GAUSS_WEIGHTS, speeds @ INTEGRAL
        reached = np.cumsum(lengths)
        start = np.concatenate(([0.0], reached[:-1]))
        at_start, at_end = _length(here.velocity(u)), _length(here.velocity(u + widths))
        slowest = int(at_start.argmin())
        if not at_start[slowest] > LEAST * reached[-1]:
            raise GeometryError(_cusp(int(which[slowest]), float(u[slowest])))
        guess = _guess(u, widths, lengths, (1.0 / at_start, 1.0 / at_end))
        cells = np.column_stack((start, u, widths, guess, integral))
        self._inverse = _Inverse(curves, which, cells)
        self.length = float(reached[-1])
        # every curve has one node more than cells, and that one stands at ``last``
        last, nodes = ends + numbers, len(which) + len(curves)
        at_ends = CubicBezier.column(curves, numbers).curvature(np.ones(len(curves)))
        self.way: Column = _merged(nodes, inner, start, last, reached[ends - 1])
        self.curvature: Column = _merged(nodes, inner, here.curvature(u), last, at_ends)
        middle, bend = start + integral @ HALF_POWERS, here.curvature(u + 0.5 * widths)
        self.middle_way: Column = _merged(nodes, inner, middle, last, reached[ends - 1])[:-1]
        self.middle_curvature: Column = _merged(nodes, inner, bend, last, at_ends)[:-1]
        total = np.bincount(which, weights=lengths)
        turns = np.abs(self.curvature[inner]) * total[which]
        worst = int(turns.argmax())
        if turns[worst] > MOST_TURN:
            raise GeometryError(_cusp(int(which[worst]), float(u[worst])))

    def locate(self, way: float) -> tuple[CubicBezier, float]:
        """Return the curve and its parameter at ``way`` [m] from the start of the chain."""
        return self._inverse.locate(way)


class _Inverse:
    """From the way back to the parameter of a curve, cell by cell."""

    def __init__(self, curves: Sequence[CubicBezier], which: Numbers, cells: Column) -> None:
        """Keep the table.

        Args:
            curves: The chain.
            which: (n,) number of the curve of each cell.
            cells: (n, 13) way and u at its start, width in u, four coefficients of u over the way
                since then, c_1 ... c_6 of equation (2).

        """
        self._curves, self._which, self._cells = curves, which, cells
        self._starts: list[float] = cells[:, 0].tolist()

    def locate(self, way: float) -> tuple[CubicBezier, float]:
        """Return the curve and its parameter at ``way`` [m]."""
        number = bisect_right(self._starts, way) - 1
        curve = self._curves[self._which[number]]
        start, first, width, g0, g1, g2, g3, c1, c2, c3, c4, c5, c6 = self._cells[number].tolist()
        rest = way - start
        u = g0 + rest * (g1 + rest * (g2 + rest * g3))
        x = (u - first) / width
        error = x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6))))) - rest
        return curve, float(u - error / abs(curve.velocity(u)))


def _cells(curves: Sequence[CubicBezier]) -> tuple[Numbers, Column, Column]:
    """Return for each cell the number of its curve, where it begins, how wide it is.

    Raises:
        GeometryError: Equation (1) cannot be kept, or by too many cells only.

    """
    first = min(max(FIRST_CELLS_IN_ALL // len(curves), FEWEST_FIRST), FIRST_CELLS)
    which = np.repeat(np.arange(len(curves)), first)
    u = np.tile(np.arange(first) / first, len(curves))
    widths = np.full(len(u), 1.0 / first)
    while True:
        here = CubicBezier.column(curves, which)
        with np.errstate(all='ignore'):
            change = _length(here.velocity(u + widths) / here.velocity(u) - 1.0)
        if change.max() <= CHANGE_IN_A_CELL:  # not so where one is NaN
            return which, u, widths
        change = np.nan_to_num(change / CHANGE_IN_A_CELL, nan=MOST_PARTS)
        parts = np.ceil(np.clip(change, 1.0, MOST_PARTS)).astype(int)
        counts = np.bincount(which, weights=parts)
        if counts.max() > MOST_CELLS:
            worst = int(np.where(which == counts.argmax(), parts, 0).argmax())
            raise GeometryError(_cusp(int(which[worst]), float(u[worst])))
        if counts.sum() > MOST_CELLS_IN_ALL:
            raise GeometryError(_too_winding(len(curves)))
        rank = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
        widths = np.repeat(widths / parts, parts)
        which, u = np.repeat(which, parts), np.repeat(u, parts) + rank * widths


def _merged(count: int, inner: Numbers, values: Column, last: Numbers, ends: Column) -> Column:
    """Return ``values`` at the places ``inner``, and ``ends`` at the places ``last``."""
    merged: Column = np.empty(count)
    merged[inner], merged[last] = values, ends
    return merged


def _too_winding(curves: int) -> str:
    return (
        f'the {curves} curves wind too much to be planned at once: give fewer poses, further apart '
        'and with headings along the way'
    )


def _cusp(number: int, u: float) -> str:
    return (
        f'curve {number + 1} has a cusp near {100.0 * u:.0f} % of its parameter, where a robot '
        'would have to turn about at once: give a larger delta_curve, or 0 to turn on the spot'
    )


def _guess(u: Column, widths: Column, lengths: Column, slopes: tuple[Column, Column]) -> Column:
    """Return (n, 4) coefficients of the cubics u over the way, with slopes 1 / |P'|."""
    (first, last), mean = slopes, widths / lengths
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
