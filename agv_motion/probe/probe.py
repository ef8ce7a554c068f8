"""One Granier probe: reading -> quality -> zero flow -> flux density -> sap flow in [0, 1]."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.probe.granier import flow_index, flux_density
from agv_motion.probe.normalise import RunningQuantiles, RunningRange
from agv_motion.probe.quality import Quality, ReadingJudge
from agv_motion.probe.zero_flow import ZeroFlow

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.probe.normalise import Normaliser

FLOWING = 0.02
"""[-] K above which a coarse logger no longer repeats the same value for hours."""


class Polarity(Enum):
    """What high sap flow becomes."""

    MORE_FLOW_IS_1 = 'more_flow_is_1'
    MORE_FLOW_IS_0 = 'more_flow_is_0'


class Normalisation(Enum):
    """What sap flow is a share of."""

    QUANTILES = 'quantiles'
    RANGE = 'range'
    """of the raw value, as in the original installation"""


@dataclass(frozen=True)
class ProbeParameters:
    """How a probe is read; the defaults suit a conifer with readings every 25 s to 15 min."""

    polarity: Annotated[
        str,
        Spec('what high sap flow becomes', choices=tuple(each.value for each in Polarity)),
    ] = Polarity.MORE_FLOW_IS_1.value
    normalisation: Annotated[
        str,
        Spec(
            'running quantiles of the flux density, or the running minimum and maximum of the raw '
            'value as the original installation did',
            choices=tuple(each.value for each in Normalisation),
        ),
    ] = Normalisation.QUANTILES.value
    window_days: Annotated[
        float, Spec('days over which the quantiles are taken', 'd', (1.0, 366.0))
    ] = 7.0
    low_quantile: Annotated[
        float, Spec('quantile of flux density that becomes 0', '1', (0.0, 1.0))
    ] = 0.1
    high_quantile: Annotated[
        float, Spec('quantile of flux density that becomes 1', '1', (0.0, 1.0))
    ] = 0.95
    smallest_range: Annotated[
        float, Spec('flux density below which a range is noise', 'm/s', (0.0, 1.0))
    ] = 1e-6
    learning_hours: Annotated[
        float, Spec('history needed before a sap flow is given', 'h', (0.0, 720.0))
    ] = 24.0
    opening_range: Annotated[
        float, Spec('range of the raw value before the original range opens', 'K', (0.0, 100.0))
    ] = 2.5
    night_start: Annotated[
        float, Spec('start of the hours before dawn, local solar time', 'h', (0.0, 24.0))
    ] = 2.0
    night_end: Annotated[float, Spec('their end, when zero flow is latched', 'h', (0.0, 24.0))] = (
        7.0
    )
    zero_flow_days: Annotated[
        int, Spec('nights whose highest reading is zero flow', 'd', (1, 60))
    ] = 3
    solar_offset: Annotated[
        float, Spec('local solar time minus UTC, longitude / 15', 'h', (-14.0, 14.0))
    ] = 0.0
    off_below: Annotated[
        float, Spec('temperature difference of a probe that is off', 'K', (0.0, 100.0))
    ] = 5.0
    highest: Annotated[float, Spec('temperature difference beyond belief', 'K', (0.0, 1000.0))] = (
        60.0
    )
    highest_index: Annotated[float, Spec("Granier's K beyond belief", '1', (0.1, 100.0))] = 2.0
    spike_threshold: Annotated[
        float, Spec('change against the recent median that is a spike', '1', (0.01, 10.0))
    ] = 0.15
    stuck_flowing: Annotated[
        float,
        Spec('how long the same value is believed while sap flows', 'h', (0.01, 1e3)),
    ] = 4.0
    stuck_resting: Annotated[
        float,
        Spec('how long the same value is believed at zero flow', 'h', (0.01, 1e3)),
    ] = 18.0

    def __post_init__(self) -> None:
        """Check every row, and the order of those that come in pairs."""
        check(self)
        for low, high in (
            ('low_quantile', 'high_quantile'),
            ('night_start', 'night_end'),
            ('off_below', 'highest'),
        ):
            if getattr(self, low) >= getattr(self, high):
                msg = (
                    f'{low} = {getattr(self, low)} is not below {high} = {getattr(self, high)}: '
                    'exchange or correct them'
                )
                raise ConfigurationError(msg)


class ProbeReading(NamedTuple):
    """What is known of a probe after one reading."""

    time: float
    """[s] since 1970, UTC, of the reading"""
    temperature_difference: float
    """[K] dT as read; NaN where missing"""
    quality: Quality
    zero_flow: float | None
    """[K] dT_max; None before the end of the first night"""
    flow_index: float | None
    """[-] Granier's K, negative where dT is above dT_max; None where it cannot be known"""
    flux_density: float | None
    """[m/s] sap flux density; None where it cannot be known"""
    sap_flow: float | None
    """[-] in [0, 1]; None where it cannot be known: then the tree must rest"""


class Probe:
    """One probe and all that it remembers."""

    def __init__(self, parameters: ProbeParameters) -> None:
        """Start without a past."""
        self._parameters = given = parameters
        self._judge = ReadingJudge(
            given.off_below,
            given.highest,
            given.spike_threshold,
            (given.stuck_flowing * 3600.0, given.stuck_resting * 3600.0),
        )
        self._zero_flow = ZeroFlow(
            given.night_start, given.night_end, given.zero_flow_days, given.solar_offset
        )
        self._normaliser: Normaliser = (
            RunningRange(given.opening_range)
            if Normalisation(given.normalisation) is Normalisation.RANGE
            else RunningQuantiles(
                (given.low_quantile, given.high_quantile),
                given.window_days,
                given.smallest_range,
                given.learning_hours,
            )
        )
        self._flowing = False
        self._last_usable: tuple[float, float] | None = None

    def update(self, time: float, temperature_difference: float) -> ProbeReading:
        """Take in one reading.

        Args:
            time: Of the reading, seconds since 1970, UTC.
            temperature_difference: dT [K]; NaN where the reading is missing.

        """
        quality = self._judge.judge(time, temperature_difference, flowing=self._flowing)
        if not quality.usable:
            return self._unknown(time, temperature_difference, quality)
        before = self._zero_flow.value
        if before is not None:
            index = flow_index(temperature_difference, before)
            if index > self._parameters.highest_index:
                return self._unknown(time, temperature_difference, Quality.OUT_OF_RANGE)
        zero_flow = self._zero_flow.update(time, temperature_difference)
        self._last_usable = time, temperature_difference
        if zero_flow is None:
            return self._unknown(time, temperature_difference, quality)
        index = flow_index(temperature_difference, zero_flow)
        self._flowing = index > FLOWING
        flux = flux_density(index)
        share = self._share(time, temperature_difference, flux)
        if index < 0.0:
            quality = Quality.NEGATIVE_FLOW
        return ProbeReading(time, temperature_difference, quality, zero_flow, index, flux, share)

    def _share(self, time: float, temperature_difference: float, flux: float) -> float | None:
        """Normalise; the raw value of the original falls when flow rises, hence its turn."""
        if Normalisation(self._parameters.normalisation) is Normalisation.RANGE:
            raw = self._normaliser.update(time, temperature_difference)
            share = None if raw is None else 1.0 - raw
        else:
            share = self._normaliser.update(time, flux)
        if share is None or Polarity(self._parameters.polarity) is Polarity.MORE_FLOW_IS_1:
            return share
        return 1.0 - share

    def _unknown(self, time: float, value: float, quality: Quality) -> ProbeReading:
        return ProbeReading(time, value, quality, self._zero_flow.value, None, None, None)

    def warm_up(self, history: Iterable[tuple[float, float]]) -> None:
        """Learn from past readings, (time [s], dT [K]) in order of time."""
        for time, value in history:
            self.update(time, value)

    def recalibrate(self) -> float:
        """Take the last usable reading as zero flow and return it [K].

        Raises:
            ConfigurationError: There has been none.

        """
        if self._last_usable is None:
            msg = 'no usable reading yet: wait for one, then recalibrate before dawn'
            raise ConfigurationError(msg)
        self._zero_flow.recalibrate(*self._last_usable)
        return self._last_usable[1]

    def state(self) -> dict[str, Any]:
        """Return what must survive a restart, ready for JSON."""
        return {'zero_flow': self._zero_flow.state(), 'normaliser': self._normaliser.state()}

    def restore(self, state: dict[str, Any]) -> None:
        """Take up a :meth:`state`.

        Raises:
            ConfigurationError: It is not one, or of another normalisation.

        """
        if not isinstance(state, dict) or not {'zero_flow', 'normaliser'} <= state.keys():
            msg = f'saved probe state {state!r:.60} is not one: delete the state file'
            raise ConfigurationError(msg)
        self._zero_flow.restore(state['zero_flow'])
        self._normaliser.restore(state['normaliser'])
