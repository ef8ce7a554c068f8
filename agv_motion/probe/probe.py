"""One Granier probe: reading -> quality -> zero flow -> flux density -> sap flow in [0, 1]."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.probe.conversion import Conversion
from agv_motion.probe.environment import UNKNOWN, Environment
from agv_motion.probe.loss import NOTHING, LossLadder, SapFlowEstimate
from agv_motion.probe.normalise import RunningQuantiles, RunningRange
from agv_motion.probe.parameters import Normalisation, Polarity, ProbeParameters
from agv_motion.probe.quality import Quality, ReadingJudge
from agv_motion.probe.zero_flow import ZeroFlow
from agv_motion.probe.zero_flow_method import method_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.probe.normalise import Normaliser

FLOWING = 0.02
"""[-] K above which a coarse logger no longer repeats the same value for hours."""


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
    estimate: SapFlowEstimate = NOTHING
    """the sap flow, or what stands in for it while the probe is lost"""


class _Usable(NamedTuple):
    """The last reading that could be used; all 0 before the first."""

    time: float = 0.0
    temperature_difference: float = 0.0
    flowing: bool = False


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
            given.noise_above,
        )
        method = method_of(given.zero_flow_method, given.zero_flow_days, given.environment)
        self._zero_flow = ZeroFlow(given.night_start, given.night_end, method, given.solar_offset)
        self._judge.level.settling = given.settling
        self._conversion = Conversion(
            given.calibration.chosen(), given.needle_in_sapwood, given.damping
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
        self._ladder = LossLadder(given.loss)
        self._last = _Usable()

    def update(
        self, time: float, temperature_difference: float, environment: Environment = UNKNOWN
    ) -> ProbeReading:
        """Take in one reading.

        Args:
            time: Of the reading, seconds since 1970, UTC.
            temperature_difference: dT [K]; NaN where the reading is missing.
            environment: The air at that time, for the zero flow that is known by it.

        """
        reading = self._read(time, temperature_difference, environment)
        if reading.quality is Quality.NOISE:
            self._distrust(self._judge.level.noise_since)
        return reading._replace(estimate=self._ladder.update(time, reading.sap_flow))

    def _read(
        self, time: float, temperature_difference: float, environment: Environment
    ) -> ProbeReading:
        quality = self._judge.judge(time, temperature_difference, flowing=self._last.flowing)
        if self._judge.level.has_stepped:
            self._zero_flow.step(temperature_difference)
        if not quality.usable:
            return self._unknown(time, temperature_difference, quality)
        before = self._zero_flow.last_known
        if before is not None:
            index = self._conversion.index(time, temperature_difference, before)
            if index > self._parameters.highest_index:
                return self._unknown(time, temperature_difference, Quality.OUT_OF_RANGE)
        zero_flow = self._zero_flow.update(time, temperature_difference, environment)
        self._last = _Usable(time, temperature_difference, self._last.flowing)
        if zero_flow is None:
            return self._unknown(time, temperature_difference, quality)
        index = self._conversion.index(time, temperature_difference, zero_flow)
        self._last = self._last._replace(flowing=index > FLOWING)
        flux = self._conversion.calibration.flux_density(index)
        share = self._share(time, temperature_difference, flux)
        if index < 0.0:
            quality = Quality.NEGATIVE_FLOW
        return ProbeReading(time, temperature_difference, quality, zero_flow, index, flux, share)

    def _distrust(self, since: float) -> None:
        """Take back all that was learnt from ``since`` [s] on: it was noise before it was known."""
        for learner in (self._zero_flow, self._normaliser, self._ladder):
            learner.distrust(since)

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

    def stand_in(self, last: ProbeReading, later: float) -> ProbeReading:
        """Return what stands in for a reading that has not come ``later`` [s] than the last."""
        estimate = self._ladder.update(last.time + later, None)
        missing = self._unknown(last.time, nan, Quality.MISSING)
        return missing._replace(estimate=estimate)

    def recalibrate(self) -> float:
        """Take the last usable reading as zero flow and return it [K].

        Raises:
            ConfigurationError: There has been none.

        """
        if not self._last.temperature_difference:
            msg = 'no usable reading yet: wait for one, then recalibrate before dawn'
            raise ConfigurationError(msg)
        self._zero_flow.recalibrate(self._last.time, self._last.temperature_difference)
        return self._last.temperature_difference

    def state(self) -> dict[str, Any]:
        """Return what must survive a restart, ready for JSON."""
        return {
            'zero_flow': self._zero_flow.state(),
            'normaliser': self._normaliser.state(),
            'course': self._ladder.course.state(),
        }

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
        self._ladder.course.restore(state.get('course', []))  # older files have none
