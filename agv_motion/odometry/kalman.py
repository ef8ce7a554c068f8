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

import numpy as np

from agv_motion.odometry.covariance import Covariance

Vector = tuple[float, float, float]

STEEP = 1e6
"""[-] Ratio of variances, before and measured, above which rounding would show."""


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
    rows, steep = _whitened(missed, noise, count), False
    for a, b, c, value in rows:
        gx, gy, gt = a * xx + b * xy + c * xt, a * xy + b * yy + c * yt, a * xt + b * yt + c * tt
        variance = a * gx + b * gy + c * gt + 1.0
        steep = steep or not variance < STEEP
        left = value - a * x - b * y - c * turn
        distance += left * left / variance
        kx, ky, kt = gx / variance, gy / variance, gt / variance
        x, y, turn = x + kx * left, y + ky * left, turn + kt * left
        xx, xy, xt = xx - kx * gx, xy - kx * gy, xt - kx * gt
        yy, yt, tt = yy - ky * gy, yt - ky * gt, tt - kt * gt
    if steep:
        return Update((x, y, turn), _sound(prior, rows), distance)
    return Update((x, y, turn), Covariance(xx, xy, xt, yy, yt, tt), distance)


def _sound(prior: Covariance, rows: list[tuple[float, float, float, float]]) -> Covariance:
    """Return the covariance afterwards in Joseph's form, which no rounding makes negative.

    Needed where a measurement is so much surer than what was known that little is left of it.
    """
    xx, xy, xt, yy, yt, tt = prior
    spread = np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
    for a, b, c, _ in rows:
        row = np.array([a, b, c])
        gain = spread @ row / (row @ spread @ row + 1.0)
        kept = np.eye(3) - np.outer(gain, row)
        spread = kept @ spread @ kept.T + np.outer(gain, gain)
    (xx, xy, xt), (_, yy, yt), (_, _, tt) = spread.tolist()
    return Covariance(xx, xy, xt, yy, yt, tt)


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
