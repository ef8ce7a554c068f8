"""The air round a tree: whether the hours before dawn are such that no sap can flow."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import fsum, isfinite, nan, sqrt
from typing import Annotated, NamedTuple

from agv_motion.parameters import Spec, check


class Environment(NamedTuple):
    """What a logger tells beside its probes; NaN where it tells nothing."""

    radiation: float = nan
    """[W/m2] of the sun, on a level surface"""
    vapour_pressure_deficit: float = nan
    """[kPa] of the air"""


UNKNOWN = Environment()
"""of a logger that has probes alone"""


@dataclass(frozen=True)
class EnvironmentParameters:
    """When a night tells zero flow: dark, moist air, and a reading that stands still.

    Source: the method `ed` of R. L. Peters et al., "Quantification of uncertainties in conifer sap
    flow measured with the thermal dissipation method", New Phytologist 219, 2018, with the
    thresholds of the R package TREX (Methods in Ecology and Evolution 12, 2021).
    """

    radiation_below: Annotated[
        float, Spec('mean solar radiation of a night that counts; 0: not asked', 'W/m2', (0, 1e3))
    ] = 30.0
    vpd_below: Annotated[
        float, Spec('mean vapour pressure deficit of one; 0: not asked', 'kPa', (0.0, 10.0))
    ] = 0.1
    variation_below: Annotated[
        float, Spec('coefficient of variation of dT in one', '%', (0.01, 100.0))
    ] = 0.5
    hours: Annotated[
        float, Spec('over which these are taken, before the highest reading', 'h', (0.25, 12.0))
    ] = 2.0
    days: Annotated[int, Spec('how long such a night tells zero flow', 'd', (1, 366))] = 30

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


COVERED = 0.75
"""Share of the hours that readings must span before anything is said of them."""


class QuietAir:
    """The last hours of readings, and whether sap can have flowed in them."""

    def __init__(self, parameters: EnvironmentParameters) -> None:
        """Start without a past."""
        self._given = parameters
        self._length = parameters.hours * 3600.0
        self._rows: deque[tuple[float, float, Environment]] = deque()

    def add(self, time: float, temperature_difference: float, environment: Environment) -> None:
        """Take in a good reading [K] at ``time`` [s], and the air at that time."""
        if self._rows and time < self._rows[-1][0]:
            self._rows.clear()  # a clock set back
        self._rows.append((time, temperature_difference, environment))
        while time - self._rows[0][0] >= self._length:
            self._rows.popleft()

    def is_quiet(self) -> bool:
        """Tell whether no sap can have flowed in the last hours; False where it is not known."""
        rows = self._rows
        if len(rows) < 3 or rows[-1][0] - rows[0][0] < COVERED * self._length:
            return False
        if _variation([value for _, value, _ in rows]) > self._given.variation_below:
            return False
        air = [environment for _, _, environment in rows]
        return _is_low([each.radiation for each in air], self._given.radiation_below) and _is_low(
            [each.vapour_pressure_deficit for each in air], self._given.vpd_below
        )


def _variation(values: list[float]) -> float:
    """Return the coefficient of variation [%]."""
    mean = fsum(values) / len(values)
    square = fsum((value - mean) ** 2 for value in values) / (len(values) - 1)
    return 100.0 * sqrt(square) / mean


def _is_low(values: list[float], limit: float) -> bool:
    if not limit:
        return True
    told = [value for value in values if isfinite(value)]
    return bool(told) and fsum(told) / len(told) <= limit
