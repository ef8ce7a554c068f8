"""Node `granier_probe`: readings of Granier probes in, sap flow in [0, 1] out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Illuminance
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.model.frames import FrameParameters
from agv_motion.nodes.probe_readings import ProbeReadings
from agv_motion.nodes.water_report import WaterReport
from agv_motion.parameters import Spec, check
from agv_motion.probe import state_file
from agv_motion.probe.condition import ProbeConditions
from agv_motion.probe.natural_gradient import without_natural_gradient
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe, ProbeReading
from agv_motion.probe.signals import Signals, signals_of
from agv_motion.probe.sources.simulated import SimulatedSource
from agv_motion.probe.sources.sources import SourceParameters
from agv_motion.probe.water import WaterParameters
from agv_motion.ros.diagnosis import OK, WARN, Diagnosis
from agv_motion.ros.messages import seconds_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import run
from agv_motion.saved_state import not_kept
from agv_motion.simulation.shade import LUX_PER_WATT, irradiance
from agv_motion.sun import sun

if TYPE_CHECKING:
    from agv_motion.probe.sources.source import ProbeSample, ProbeSource
    from agv_motion.ros.port import Port


SAVE_PERIOD = 30.0
"""[s] A power cut loses at most this much of what was learnt."""


@dataclass(frozen=True)
class GranierProbeParameters(SourceParameters, FrameParameters):
    """Where the readings come from and what is made of them."""

    rate: Annotated[
        float, Spec('how often the source is read and the sap flow told', 'Hz', (0.01, 100.0))
    ] = 1.0
    assign: Annotated[
        tuple[str, ...], Spec('which probe is s1 (speed), s2 (rotation), s3 (places)')
    ] = ('probe_1', 'probe_2', 'probe_3')
    reference_probe: Annotated[
        str, Spec('probe that is not heated and tells the natural gradient; empty: none is')
    ] = ''
    max_age: Annotated[
        float,
        Spec('a reading older than this is lost; 0: three periods of the source', 's', (0, 1e6)),
    ] = 0.0
    state_file: Annotated[
        str, Spec('where to keep what was learnt over a restart; empty: nowhere')
    ] = ''
    probe: ProbeParameters = field(default_factory=ProbeParameters)
    water: WaterParameters = field(default_factory=WaterParameters)

    def __post_init__(self) -> None:
        """Check every row, and that the assigned probes exist."""
        check(self)
        names = [f'probe_{i + 1}' for i in range(self.probes())]
        if len(self.assign) != 3 or not set(self.assign) <= set(names):
            msg = f'assign = {list(self.assign)}: give three names among {", ".join(names)}'
            raise ConfigurationError(msg)
        if self.reference_probe and self.reference_probe not in set(names) - set(self.assign):
            msg = (
                f"reference_probe = '{self.reference_probe}': give one of {', '.join(names)} that "
                f'is none of assign = {list(self.assign)}, since it is not heated'
            )
            raise ConfigurationError(msg)
        if self.probe.needs_environment:
            self.require(self.probe.environment)


class GranierProbe(PlainNode[GranierProbeParameters]):
    """Source -> `granier/probe_i/temperature_difference`, `granier/sap_flow`, `granier/valid`.

    `granier/sap_flow` is told only while all three probes are fresh and believable, or what stands
    in for a lost one is still good; when it is not, `granier/valid` turns false and says that the
    tree must rest. `granier/state` tells what stands in.
    """

    name = 'granier_probe'
    takes = GranierProbeParameters

    def __init__(
        self, port: Port, parameters: GranierProbeParameters, source: ProbeSource | None = None
    ) -> None:
        """Open the source, unless another is given, and the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._source = source or given.open_source()
        self._probes = [Probe(given.probe) for _ in range(given.probes())]
        self._chosen = [int(name.removeprefix('probe_')) - 1 for name in given.assign]
        self._readings: list[ProbeReading | None] = [None] * len(self._probes)
        self._conditions = ProbeConditions(given.assign, len(self._probes))
        self._read_at = port.seconds()
        self._max_age = given.max_age or max(3.0 * self._source.period, 5.0 / given.rate)
        self._signals = signals_of(self._chosen, self._readings, given.probe.loss.enough)
        self._losses = ''
        self._why_invalid: str | None = None
        self._message = Vector3Stamped()
        self._message.header.frame_id = given.base_frame
        self._told = ProbeReadings(
            port,
            [given.own(f'probe_{i + 1}') for i in range(len(self._probes))],
            air=given.probe.needs_environment,
            logger=given.has_logger,
        )
        self._water = (
            WaterReport(port, given.water, given.probe, given.base_frame)
            if given.water.sapwood_area
            else None
        )
        self._sap_flow = port.publisher(Vector3Stamped, 'granier/sap_flow', SENSOR, sole=True)
        self._valid = port.publisher(Bool, 'granier/valid', LATCHED)
        self._state = port.publisher(String, 'granier/state', LATCHED)
        port.serve(Trigger, '~/recalibrate', self._on_recalibrate)
        if isinstance(self._source, SimulatedSource):
            port.listen(Illuminance, 'sunlight', self._on_sunlight, SENSOR)
            port.need('sunlight')
        port.every(1.0 / given.rate, self.tick)
        if given.state_file:
            port.every(SAVE_PERIOD, self._save, steady=True)
            complaint = state_file.restore(given.state_file, self._probes)
            if complaint:
                port.warning(complaint)
            self._save()  # so that a disk that takes nothing is told before it matters
        self._learnt = False

    def halt(self) -> None:
        """Say that nothing more will come, and keep what was learnt."""
        self._valid.publish(Bool(data=False))
        if self.parameters.state_file:
            self._save()
        self._source.close()

    def diagnose(self) -> Diagnosis:
        """Tell of each probe."""
        values = {
            f'probe_{i + 1}': 'no reading'
            if reading is None
            else f'{reading.quality.value}, dT {reading.temperature_difference:.3f} K, '
            f'zero flow {_shown(reading.zero_flow, "{:.3f} K")}, '
            f'sap flow {_shown(reading.sap_flow, "{:.2f}")}'
            for i, reading in enumerate(self._readings)
        }
        values |= self._conditions.values(self._readings)
        values |= self._water.values() if self._water else {}
        values['source silent [s]'] = f'{self._silence(self.port.seconds()):.1f}'
        values['source silent limit [s]'] = f'{self._max_age:.1f}'
        if self._why_invalid:
            return Diagnosis(WARN, f'resting: {self._why_invalid}', values)
        if self._losses:
            return Diagnosis(WARN, self._losses, values)
        return Diagnosis(OK, 'all probes believable', values)

    def tick(self) -> None:
        """Read the source, and tell the sap flow or why there is none."""
        seconds = self.port.seconds()
        if not self._learnt:
            self._learn(seconds)
        for sample in self._source.read(seconds):
            self._take(sample, seconds)
        complaint = self._source.complaint()
        if complaint:
            self.port.refuse(complaint)
        silent = self._silence(seconds) > self._max_age
        why = (self._without_source(seconds) if silent else self._signals).doubt
        if why != self._why_invalid:
            self._tell_validity(why)
        if not why:
            self.port.stamp(self._message)  # believed now, whenever it was read
            self._sap_flow.publish(self._message)

    def _without_source(self, now: float) -> Signals:
        """Return what the tree may move by while the source says nothing: no probe is measured."""
        silence = self._silence(now)
        nothing = f'no reading for {silence:.0f} s (limit {self._max_age:.0f} s)'
        if self._signals.doubt:
            return self._signals
        if not self.parameters.probe.loss.stands_in:
            return Signals((), nothing, '')
        later = silence * self.parameters.pace
        for i, reading in enumerate(self._readings):
            if reading is not None:
                self._readings[i] = self._probes[i].stand_in(reading, later)
        self._conditions.update(now, self._readings)
        signals = self._tell_signals()
        return signals._replace(doubt=nothing if signals.doubt else '')

    def _silence(self, now: float) -> float:
        """Return how long the source has said nothing [s]."""
        return abs(now - self._read_at)

    def _learn(self, now: float) -> None:
        """Learn from the history of the source; at the first tick, when the clock is known."""
        self._learnt = True
        for sample in self._source.history(now):
            readings = [
                probe.update(sample.time, value, sample.environment)
                for probe, value in zip(self._probes, self._corrected(sample), strict=True)
            ]
            if self._water is not None:
                self._water.update(sample.time, self._heated(readings), tell=False)

    def _heated(self, readings: list[Any]) -> list[Any]:
        """Return what the probes say that are heated."""
        reference = self.parameters.reference_probe
        return [each for i, each in enumerate(readings, 1) if reference != f'probe_{i}']

    def _corrected(self, sample: ProbeSample) -> tuple[float, ...]:
        """Return the temperature differences without the natural gradient, if that is told [K]."""
        if not self.parameters.reference_probe:
            return sample.values
        reference = int(self.parameters.reference_probe.removeprefix('probe_')) - 1
        return without_natural_gradient(sample.values, reference)

    def _take(self, sample: ProbeSample, now: float) -> None:
        """Let the probes see one sample, and publish what was read."""
        self._read_at = now
        self._told.publish(sample)
        for i, value in enumerate(self._corrected(sample)):
            self._readings[i] = self._probes[i].update(sample.time, value, sample.environment)
        self._conditions.update(now, self._readings)
        if self._water is not None:
            self._water.update(sample.time, self._heated(self._readings), tell=True)
        self._signals = self._tell_signals()

    def _tell_signals(self) -> Signals:
        """Return what the tree may move by, and tell by what it is known."""
        signals = signals_of(self._chosen, self._readings, self.parameters.probe.loss.enough)
        vector = self._message.vector
        if signals.values:
            vector.x, vector.y, vector.z = signals.values
        if signals.losses != self._losses:
            self._losses = signals.losses
            self._state.publish(String(data=self._losses))
            self.port.info(self._losses or 'no probe is lost any more')
        return signals

    def _tell_validity(self, why: str) -> None:
        self._why_invalid = why
        self._valid.publish(Bool(data=not why))
        self.port.info(f'resting: {why}' if why else 'all probes believable')

    def _on_recalibrate(self, _: Any) -> str:
        values = [probe.recalibrate() for probe in self._probes]
        return 'zero flow is now ' + ', '.join(f'{value:.3f} K' for value in values)

    def _on_sunlight(self, message: Illuminance) -> None:
        """Let the simulated tree feel the light of its place, as a share of that in the open."""
        given = self.parameters.simulated
        time = seconds_of(message.header.stamp)
        open_sky = irradiance(0, 0, sun(time, given.latitude, 15.0 * given.solar_offset), [])
        if open_sky > 0.0 and isinstance(self._source, SimulatedSource):
            self._source.set_light(message.illuminance / (LUX_PER_WATT * open_sky))

    def _save(self) -> None:
        try:
            state_file.save(self.parameters.state_file, self._probes)
        except OSError as error:
            file = self.parameters.state_file
            self.port.refuse(not_kept('what was learnt', file, error))


def _shown(value: float | None, form: str) -> str:
    return 'unknown' if value is None else form.format(value)


def main() -> None:
    """Run the node."""
    run(GranierProbe)


if __name__ == '__main__':
    main()
