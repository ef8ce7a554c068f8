"""What a tree drinks: litres an hour and a day from the flux densities of its probes.

    Q = A mean(F),    F = a K**b

Three things make it uncertain: the calibration (spread of ln F between trees of a kind), the area
of the sapwood, and zero flow. The first two are factors, the third moves F by
``dF = a b K**(b - 1) dK`` with ``dK = sigma / dT``, and moves it all day the same way, since dT_max
is one value a day. The interval holds 95 % of a log-normal distribution with all three variances.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log1p, sqrt
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.parameters import Spec, check

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.calibration import FluxCalibration
    from agv_motion.probe.probe import ProbeReading

DAY, HOUR, LITRES = 86400.0, 3600.0, 1000.0
NORMAL_95 = 1.959963984540054
"""Standard deviations on either side of the mean that hold 95 % of a normal distribution."""
LONGEST_GAP = 3600.0
"""[s] over which flow is taken to change in a straight line; in a longer gap it is unknown."""


@dataclass(frozen=True)
class WaterParameters:
    """The sapwood that the probes stand for; without an area no water is told."""

    sapwood_area: Annotated[
        float, Spec('of the trunk at the probes; 0: not told', 'm2', (0, 10))
    ] = 0.0
    area_spread: Annotated[
        float, Spec('standard deviation of the area as a share of it', '1', (0.0, 1.0))
    ] = 0.1
    zero_flow_spread: Annotated[
        float, Spec('standard deviation of zero flow', 'K', (0.0, 10.0))
    ] = 0.1

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Litres(NamedTuple):
    """An amount, or an amount an hour, with its 95 % interval."""

    value: float
    low: float
    high: float


class WaterUse(NamedTuple):
    """What is known after a reading."""

    rate: Litres
    """[l/h] now"""
    day: Litres
    """[l] since midnight"""
    known: float
    """[s] of this day in which the flow was known"""


class WaterMeter:
    """Adds up what a tree drinks from midnight to midnight, local solar time."""

    def __init__(
        self, parameters: WaterParameters, calibration: FluxCalibration, solar_offset: float
    ) -> None:
        """Start at nothing.

        Args:
            parameters: Area of the sapwood and what is uncertain.
            calibration: By which the flux densities were computed.
            solar_offset: Local solar time minus UTC [h].

        """
        self._given, self._calibration = parameters, calibration
        self._offset = solar_offset * HOUR
        self._before: tuple[float, float, float] | None = None
        """time [s], flow [m3/s], and by how much zero flow may move it [m3/s]"""
        self._day = 0
        self._sums = 0.0, 0.0, 0.0
        """of this day: drunk [m3], by how much zero flow may move it [m3], known [s]"""

    def update(self, time: float, readings: Sequence[ProbeReading | None]) -> WaterUse | None:
        """Take in the readings of all probes at ``time`` [s]; None where no flow is known."""
        self._begin_day(time)
        rows = [self._flux(each) for each in readings if each and each.flux_density is not None]
        if not rows:
            return None
        area = self._given.sapwood_area
        flow = area * sum(flux for flux, _ in rows) / len(rows)
        moved = area * sqrt(sum(moved * moved for _, moved in rows)) / len(rows)
        if self._before is not None and 0.0 < time - self._before[0] <= LONGEST_GAP:
            dt = min(time - self._before[0], (time + self._offset) % DAY)  # what is of this day
            steps = 0.5 * dt * (flow + self._before[1]), 0.5 * dt * (moved + self._before[2]), dt
            drunk, drunk_moved, known = self._sums
            self._sums = drunk + steps[0], drunk_moved + steps[1], known + steps[2]
        self._before = time, flow, moved
        return WaterUse(
            self._litres(flow * HOUR, moved * HOUR),
            self._litres(*self._sums[:2]),
            self._sums[2],
        )

    def _begin_day(self, time: float) -> None:
        day = int((time + self._offset) // DAY)
        if day != self._day:
            self._day, self._sums = day, (0.0, 0.0, 0.0)

    def _flux(self, reading: ProbeReading) -> tuple[float, float]:
        """Return flux density [m/s] and by how much zero flow may move it."""
        flux, index = reading.flux_density or 0.0, reading.flow_index or 0.0
        if index <= 0.0:
            return 0.0, 0.0
        spread = self._given.zero_flow_spread / reading.temperature_difference
        return flux, flux * self._calibration.exponent * spread / index

    def _litres(self, volume: float, moved: float) -> Litres:
        """Return an amount [m3] in litres with its interval."""
        if volume <= 0.0:
            return Litres(0.0, 0.0, LITRES * NORMAL_95 * moved)
        variance = (
            self._calibration.spread**2
            + log1p(self._given.area_spread**2)
            + log1p((moved / volume) ** 2)
        )
        factor = exp(NORMAL_95 * sqrt(variance))
        return Litres(LITRES * volume, LITRES * volume / factor, LITRES * volume * factor)


class DayOfWater(NamedTuple):
    """What a tree drank in a day."""

    day: int
    """since 1970, of local solar time"""
    drunk: Litres
    """[l]"""
    highest: Litres
    """[l/h]"""
    known: float
    """share of the day in which the flow was known"""


def days_of(
    meter: WaterMeter, times: Sequence[float], rows: Sequence[Sequence[ProbeReading]], offset: float
) -> list[DayOfWater]:
    """Return what was drunk on each day on which anything is known.

    Args:
        meter: New, of the tree.
        times: (n,) of the readings [s], not decreasing.
        rows: (n, probes) readings.
        offset: Local solar time minus UTC [h].

    """
    found: dict[int, DayOfWater] = {}
    for time, readings in zip(times, rows, strict=True):
        told = meter.update(time, readings)
        if told is not None:
            day = int((time + offset * HOUR) // DAY)
            before = found.get(day)
            rate = told.rate if before is None else max(before.highest, told.rate)
            found[day] = DayOfWater(day, told.day, rate, told.known / DAY)
    return list(found.values())
