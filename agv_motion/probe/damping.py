"""Damping: the wound round an old probe grows, and K falls though as much sap flows.

The share of K that is left ``t`` days after installation is ``f(t) / f(0)`` with

    f(t) = (a + b t) / (1 + c t + d t**2)

Source: R. L. Peters et al., "Quantification of uncertainties in conifer sap flow measured with the
thermal dissipation method", New Phytologist 219, 2018, equation of the dampening correction.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timezone
from typing import TYPE_CHECKING, Annotated

import numpy as np

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

DAY = 86400.0
LEFT = 0.1
"""Share of K below which nothing is left that could be corrected."""


@dataclass(frozen=True)
class DampingParameters:
    """When a probe was installed, and how its K falls; without a day nothing is corrected."""

    installed: Annotated[
        str, Spec('day on which the needles were set, YYYY-MM-DD; empty: correct nothing')
    ] = ''
    a: Annotated[float, Spec('of the share of K that is left', '1', (1e-6, 1e6))] = 1.0
    b: Annotated[float, Spec('of it, with the days', '1/d', (-1e3, 1e3))] = 0.0
    c: Annotated[float, Spec('of it, below the line', '1/d', (0.0, 1e3))] = 0.0
    d: Annotated[float, Spec('of it, with the square of the days', '1/d2', (0.0, 1e3))] = 0.0

    def __post_init__(self) -> None:
        """Check every row, and that the day is one.

        Raises:
            ConfigurationError: A value is not allowed.

        """
        check(self)
        self.begin()

    def begin(self) -> float | None:
        """Return when the needles were set [s since 1970]; None where nothing is said."""
        if not self.installed:
            return None
        try:
            day = datetime.strptime(self.installed, '%Y-%m-%d').replace(tzinfo=timezone.utc)
        except ValueError as error:
            msg = f"installed = '{self.installed:.40}' is no day: give YYYY-MM-DD, or nothing"
            raise ConfigurationError(msg) from error
        return day.timestamp()


class Damping:
    """By what K is to be multiplied."""

    def __init__(self, parameters: DampingParameters) -> None:
        """Take the curve."""
        self._given, self._begin = parameters, parameters.begin()

    def gain(self, time: float) -> float:
        """Return by what to multiply K read at ``time`` [s since 1970]; 1 before installation.

        Where less than a tenth of K is left it is no more than ten: new needles are due.
        """
        if self._begin is None or time <= self._begin:
            return 1.0
        given, days = self._given, (time - self._begin) / DAY
        share = (given.a + given.b * days) / (1.0 + given.c * days + given.d * days * days)
        return 1.0 / max(share / given.a, LEFT)


def fit_damping(days: ArrayLike, index: ArrayLike) -> tuple[float, float, float, float]:
    """Return a, b, c, d of the curve through the highest K of days, by least squares.

    The curve is made linear, ``K = a + b t - c t K - d t**2 K``, and solved again with each row
    divided by the last ``1 + c t + d t**2``, until it is the fit of the curve itself.

    Args:
        days: (n,) since installation.
        index: (n,) the highest K of each, seasons removed.

    Raises:
        SignalError: There are fewer than eight different days, columns of two lengths, or a value
            that is not finite.

    """
    t, k = np.asarray(days, float), np.asarray(index, float)
    if t.ndim != 1 or t.shape != k.shape or len(np.unique(t)) < 8:
        msg = f'days of shape {t.shape}, K of shape {k.shape}: give columns of eight days or more'
        raise SignalError(msg)
    if not np.isfinite([t, k]).all():
        msg = 'days and K must be finite: leave out the days without a K'
        raise SignalError(msg)
    scale = float(np.max(np.abs(t)))  # columns of one size: rounding stays rounding
    u = t / scale
    below: NDArray[np.float64] = np.ones(len(t))
    for _ in range(50):
        rows = np.column_stack([np.ones(len(u)), u, -u * k, -u * u * k]) / below[:, None]
        a, b, c, d = map(float, np.linalg.lstsq(rows, k / below, rcond=None)[0])
        below = np.maximum(1.0 + c * u + d * u * u, LEFT)
    return a, b / scale, c / scale, d / scale**2
