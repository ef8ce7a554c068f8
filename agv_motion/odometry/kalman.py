"""The Kalman update of a pose that is measured directly, in plain numbers.

The noise is whitened by its Cholesky factor; then one number after the other is taken in, each of
variance 1. That needs no inverse of a matrix, and the squared Mahalanobis distance of the whole
measurement adds up on the way.

Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with applications to tracking and
navigation", 2001, sections 5.2 and 7.4.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from agv_motion.odometry.covariance import Covariance

Vector = tuple[float, float, float]


class Update(NamedTuple):
    """What a measurement does to an estimate."""

    correction: Vector
    """To add to x [m], y [m] and turn [rad]"""
    covariance: Covariance
    """Afterwards"""
    distance: float
    """[-] squared Mahalanobis distance of the measurement from what was expected"""


def correct(prior: Covariance, missed: Vector, noise: Covariance, count: int) -> Update:
    """Take in a measurement of x and y, and of the turn when ``count`` is 3 and not 2.

    Args:
        prior: Covariance before.
        missed: Measured less expected.
        noise: Covariance of the measurement, positive definite in what is measured.
        count: How many of the three numbers were measured.

    """
    xx, xy, xt, yy, yt, tt = prior
    x = y = turn = distance = 0.0
    for a, b, c, value in _whitened(missed, noise, count):
        gx, gy, gt = a * xx + b * xy + c * xt, a * xy + b * yy + c * yt, a * xt + b * yt + c * tt
        variance = a * gx + b * gy + c * gt + 1.0
        left = value - a * x - b * y - c * turn
        distance += left * left / variance
        kx, ky, kt = gx / variance, gy / variance, gt / variance
        x, y, turn = x + kx * left, y + ky * left, turn + kt * left
        xx, xy, xt = xx - kx * gx, xy - kx * gy, xt - kx * gt
        yy, yt, tt = yy - ky * gy, yt - ky * gt, tt - kt * gt
    return Update((x, y, turn), Covariance(xx, xy, xt, yy, yt, tt), distance)


def _whitened(
    missed: Vector, noise: Covariance, count: int
) -> list[tuple[float, float, float, float]]:
    """Return rows (a, b, c, value): a x + b y + c turn = value, independent, of variance 1."""
    xx, xy, xt, yy, yt, tt = noise
    to_x, to_y, to_turn = missed
    root_x = sqrt(xx)
    a, first = 1.0 / root_x, to_x / root_x
    share = xy * a
    root_y = sqrt(yy - share * share)
    b, second = -share * a / root_y, (to_y - share * first) / root_y
    rows = [(a, 0.0, 0.0, first), (b, 1.0 / root_y, 0.0, second)]
    if count == 3:
        of_x = xt * a
        of_y = (yt - of_x * share) / root_y
        root_turn = sqrt(tt - of_x * of_x - of_y * of_y)
        third = (to_turn - of_x * first - of_y * second) / root_turn
        rows.append(
            (
                -(of_x * a + of_y * b) / root_turn,
                -of_y / (root_y * root_turn),
                1.0 / root_turn,
                third,
            )
        )
    return rows
