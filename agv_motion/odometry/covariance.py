r"""Covariance of a small displacement in the plane: six numbers, and how frames change them.

The displacement is :math:`(\rho_x, \rho_y, \varphi)`: a translation and a turn about the origin of
its frame. Seen from another origin the same turn also translates, so uncertainty of the heading
becomes uncertainty of the position with the distance. That map (the adjoint of SE(2)) is linear
and exact.

Source: T. D. Barfoot, P. T. Furgale, "Associating uncertainty with three-dimensional poses for use
in estimation problems", IEEE Trans. Robot. 30(3), 2014, in its planar form.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple


class Covariance(NamedTuple):
    """The upper triangle of a symmetric 3 x 3 matrix over x [m], y [m] and turn [rad]."""

    xx: float
    xy: float
    xt: float
    yy: float
    yt: float
    tt: float


CERTAIN = Covariance(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def add(first: Covariance, second: Covariance) -> Covariance:
    """Return the covariance of the sum of two independent displacements."""
    return Covariance(*[a + b for a, b in zip(first, second, strict=True)])


def scale(covariance: Covariance, factor: float) -> Covariance:
    """Return ``covariance`` with every entry times ``factor``."""
    return Covariance(*[factor * entry for entry in covariance])


def rotate(covariance: Covariance, angle: float) -> Covariance:
    """Return ``covariance`` in a frame from which its own is seen turned by ``angle`` [rad]."""
    xx, xy, xt, yy, yt, tt = covariance
    c, s = cos(angle), sin(angle)
    both, cross = c * c * xx + s * s * yy, 2.0 * c * s * xy
    return Covariance(
        both - cross,
        c * s * (xx - yy) + (c * c - s * s) * xy,
        c * xt - s * yt,
        xx + yy - both + cross,
        s * xt + c * yt,
        tt,
    )


def shift(covariance: Covariance, x: float, y: float) -> Covariance:
    r"""Return ``covariance`` with its origin moved to ``(x, y)`` [m].

    .. math:: \rho' = \rho + \varphi\,(-y, x)
    """
    xx, xy, xt, yy, yt, tt = covariance
    return Covariance(
        xx - 2.0 * y * xt + y * y * tt,
        xy + x * xt - y * yt - x * y * tt,
        xt - y * tt,
        yy + 2.0 * x * yt + x * x * tt,
        yt + x * tt,
        tt,
    )


def is_positive_definite(covariance: Covariance) -> bool:
    """Return whether every combination of x, y and turn has a positive variance (Sylvester)."""
    xx, xy, xt, yy, yt, tt = covariance
    minor = xx * yy - xy * xy
    determinant = tt * minor - yt * (xx * yt - xt * xy) + xt * (xy * yt - yy * xt)
    return xx > 0.0 and minor > 0.0 and determinant > 0.0
