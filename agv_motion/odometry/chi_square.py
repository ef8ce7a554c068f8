"""Quantiles of the chi-square distribution: how large a sum of squared normal errors may be."""

from __future__ import annotations

from math import log, sqrt
from statistics import NormalDist

from agv_motion.errors import ConfigurationError


def chi_square_quantile(probability: float, degrees: int) -> float:
    """Return what a sum of ``degrees`` squared standard normals exceeds with 1 - ``probability``.

    Exact for one and two degrees; for more the cube of a normal, at most 2 % off for
    probabilities from 0.95 to 0.999.

    Source: E. B. Wilson, M. M. Hilferty, "The distribution of chi-square", Proc. Nat. Acad. Sci.
    17(12), 1931.

    Raises:
        ConfigurationError: The probability is not inside (0, 1), or there is no degree.

    """
    if not 0.0 < probability < 1.0 or degrees < 1:
        msg = f'probability = {probability}, degrees = {degrees}: give one in (0, 1), and 1 or more'
        raise ConfigurationError(msg)
    if degrees == 1:
        return NormalDist().inv_cdf(0.5 + 0.5 * probability) ** 2
    if degrees == 2:
        return -2.0 * log(1.0 - probability)
    spread = 2.0 / (9.0 * degrees)
    return degrees * (1.0 - spread + NormalDist().inv_cdf(probability) * sqrt(spread)) ** 3
