"""Simulated probes of a conifer in summer: any time can be asked, the same seed says the same.

Fitted to a spruce at 1300 m in the Alps: zero flow between 0.76 and 0.81 mV, daily range near
0.06 mV on fair days and a third of it on dull ones, flow rising from two hours after sunrise and
falling until three hours after sunset, steps of 0.001 mV (at 25 K/mV: 20 K, 1.5 K, 0.025 K).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, cos, exp, floor, pi, sin, sqrt, tau
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import require_finite
from agv_motion.probe.environment import Environment
from agv_motion.probe.sources.source import ProbeSample
from agv_motion.sun import half_day, solar_time

if TYPE_CHECKING:
    from collections.abc import Iterator

DAY = 86400.0
HOURS = 12.0 / pi
"""[h] by which the sun goes on in an hour angle of 1 rad"""
STOMATAL_LAG = 900.0
"""[s] time constant with which sap flow follows the light of the place."""


@dataclass(frozen=True)
class SimulatedSourceParameters:
    """The simulated tree and its logger."""

    probes: Annotated[int, Spec('number of probes', '1', (1, 16))] = 3
    period: Annotated[float, Spec('time between readings', 's', (0.01, 3600.0))] = 25.0
    seed: Annotated[int, Spec('of weather and noise', '1', (0, 2**31))] = 1
    latitude: Annotated[float, Spec('north positive', 'deg', (-65.0, 65.0))] = 48.86
    solar_offset: Annotated[float, Spec('local solar time minus UTC', 'h', (-14, 14))] = 0.16
    zero_flow: Annotated[float, Spec('temperature difference at night', 'K', (1, 60))] = 20.0
    fair_day_index: Annotated[float, Spec("Granier's K on a fair noon", '1', (0, 2))] = 0.12
    noise: Annotated[float, Spec('standard deviation of a reading', 'K', (0, 5))] = 0.01
    drift: Annotated[float, Spec('slow swing of zero flow', 'K', (0, 5))] = 0.3

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class SimulatedSource:
    """Readings as a function of time, seed and the light at the place of the tree."""

    def __init__(self, parameters: SimulatedSourceParameters, warm_up_days: float) -> None:
        """Start in full sun.

        Args:
            parameters: The tree and its logger.
            warm_up_days: How much history to offer [d].

        """
        self._given = parameters
        self._warm_up = warm_up_days * DAY
        self.period = parameters.period
        self._next: int | None = None
        self._light = self._followed_light = 1.0

    def set_light(self, factor: float) -> None:
        """Set the light at the tree's place as a share of that in the open, in [0, 1].

        Raises:
            SignalError: It is not finite; the light stays what it was.

        """
        require_finite('light as a share of that in the open', (factor,))
        self._light = min(max(factor, 0.0), 1.0)

    def history(self, now: float) -> Iterator[ProbeSample]:
        """Yield a reading every quarter of an hour before that of ``now``, in full sun."""
        for k in range(ceil((now - self._warm_up) / 900.0), floor(now / 900.0)):
            yield self.sample(900.0 * k, 1.0)

    def read(self, now: float) -> list[ProbeSample]:
        """Return the readings due since the last call; the first call gives the present one."""
        latest = floor(now / self.period)
        first = latest if self._next is None or self._next > latest + 1 else self._next
        self._next = latest + 1
        due = range(max(first, latest - 1000), latest + 1)
        return [self._follow(self.period * k) for k in due]

    def complaint(self) -> str:
        """Nothing ever goes wrong here."""
        return ''

    def close(self) -> None:
        """Hold nothing."""

    def _follow(self, time: float) -> ProbeSample:
        """Let the flow follow the light, then read."""
        share = 1.0 - exp(-self.period / STOMATAL_LAG)
        self._followed_light += share * (self._light - self._followed_light)
        return self.sample(time, self._followed_light)

    def sample(self, time: float, light: float) -> ProbeSample:
        """Return the readings at ``time`` [s since 1970] in a share ``light`` of the sun."""
        given = self._given
        values = []
        for probe in range(given.probes):
            # each probe sits on its own side of the trunk: its own share of the day, its own hour
            side = given.seed * 64 + probe
            swing = sin(tau * time / (9.0 * DAY) + side)
            zero_flow = given.zero_flow * (1.0 - 0.02 * probe) + given.drift * swing
            flow = self._day(time - 2400.0 * probe) * self._weather(time, side) * light
            noise = given.noise * gauss(side, floor(time * 100.0))
            values.append(zero_flow / (1.0 + given.fair_day_index * flow) + noise)
        return ProbeSample(time, tuple(values), self._air(time, light))

    def _air(self, time: float, light: float) -> Environment:
        """Return radiation with the sun, and a vapour pressure deficit that lags two hours."""
        sun = self._sun(time) * self._weather(time, self._given.seed * 64) * light
        warmth = self._sun(time - 7200.0)
        return Environment(900.0 * sun, 0.02 + 1.2 * warmth)

    def _sun(self, time: float) -> float:
        """Return the course of the sun on a fair day in [0, 1]; 0 at night."""
        rise, fall, hour = self._hours(time)
        return sin(pi * (hour - rise) / (fall - rise)) if rise < hour < fall else 0.0

    def _day(self, time: float) -> float:
        """Return the course of a fair day in [0, 1], shifted by the lag of the stem."""
        sunrise, sunset, hour = self._hours(time)
        rise, fall = sunrise + 2.0, sunset + 3.0
        hour += 24.0 if hour < fall - 24.0 else 0.0
        if not rise < hour < fall:
            return 0.0
        return float(sin(pi * (hour - rise) / (fall - rise)) ** 1.5)

    def _hours(self, time: float) -> tuple[float, float, float]:
        """Return sunrise, sunset and now in local solar time [h]."""
        given = self._given
        declination, hour_angle = solar_time(time, 15.0 * given.solar_offset)
        half = half_day(declination, given.latitude) * HOURS
        return 12.0 - half, 12.0 + half, 12.0 + hour_angle * HOURS

    def _weather(self, time: float, side: int) -> float:
        """Return a share in [0.15, 1]: fair and dull days, and clouds within them."""
        days = smooth_noise(self._given.seed, time / DAY)
        clouds = smooth_noise(side + 7919, time / 2400.0)
        return 0.15 + 0.85 * min(1.0, 0.3 + 1.2 * days) * (0.6 + 0.4 * clouds)


def uniform(seed: int, index: int) -> float:
    """Return a number in [0, 1) that depends on ``seed`` and ``index`` alone (splitmix64)."""
    mask = 0xFFFFFFFFFFFFFFFF
    z = (index * 0x9E3779B97F4A7C15 + seed * 0xD1B54A32D192ED03 + 0x632BE59BD9B4E019) & mask
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
    return (z ^ (z >> 31)) / 2.0**64


def gauss(seed: int, index: int) -> float:
    """Return a nearly normal number: the sum of four uniform ones, of mean 0 and deviation 1."""
    total = sum(uniform(seed + 101 * k, index) for k in range(4))
    return (total - 2.0) * sqrt(3.0)


def smooth_noise(seed: int, position: float) -> float:
    """Return noise in [0, 1) that is smooth in ``position``: cosine between whole numbers."""
    whole = floor(position)
    share = 0.5 - 0.5 * cos(pi * (position - whole))
    return (1.0 - share) * uniform(seed, whole) + share * uniform(seed, whole + 1)
