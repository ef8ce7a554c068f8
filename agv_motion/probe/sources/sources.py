"""The sources of readings by name: the one place that knows them all."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec
from agv_motion.probe.sources.csv_file import CsvSource, GrowingSource
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.mqtt_parameters import MqttParameters
from agv_motion.probe.sources.mqtt_source import MqttSource
from agv_motion.probe.sources.serial_line import SerialParameters, SerialSource
from agv_motion.probe.sources.simulated import SimulatedSource, SimulatedSourceParameters

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.probe.environment import EnvironmentParameters
    from agv_motion.probe.sources.source import ProbeSource


class SourceKind(NamedTuple):
    """One kind of source."""

    open: Callable[[Any, float], ProbeSource]
    """from its group of parameters, and the days of history to learn from"""
    probes: Callable[[Any], int]
    """number of probes that the group speaks of"""
    tells: Callable[[Any], tuple[bool, bool]]
    """whether it tells solar radiation, and the vapour pressure deficit of the air"""
    pace: Callable[[Any], float] = lambda _: 1.0
    """seconds of its own time per second"""
    has_logger: bool = True
    """whether a logger with a clock of its own reads the probes"""


SOURCES = {
    'simulated': SourceKind(
        SimulatedSource, lambda given: given.probes, lambda _: (True, True), has_logger=False
    ),
    'csv': SourceKind(
        lambda given, days: (GrowingSource if given.follow else CsvSource)(given, days),
        lambda given: len(given.columns),
        lambda given: (bool(given.radiation_column), bool(given.vpd_column)),
        lambda given: given.speed,
    ),
    'serial': SourceKind(
        lambda given, _: SerialSource(given),
        lambda given: len(given.fields),
        lambda given: (bool(given.radiation_field), bool(given.vpd_field)),
    ),
    'mqtt': SourceKind(
        lambda given, _: MqttSource(given),
        lambda given: len(given.fields),
        lambda given: (bool(given.radiation_field), bool(given.vpd_field)),
    ),
}
"""A source is added here, as a group of its name in `SourceParameters`, and in its own file."""


@dataclass(frozen=True)
class SourceParameters:
    """Where the readings come from; each source has a group of its name."""

    source: Annotated[str, Spec('where the readings come from', choices=tuple(SOURCES))] = (
        'simulated'
    )
    warm_up_days: Annotated[
        float, Spec("how much of the source's history to learn from at the start", 'd', (0, 366))
    ] = 8.0
    simulated: SimulatedSourceParameters = field(default_factory=SimulatedSourceParameters)
    csv: CsvParameters = field(default_factory=CsvParameters)
    serial: SerialParameters = field(default_factory=SerialParameters)
    mqtt: MqttParameters = field(default_factory=MqttParameters)

    def probes(self) -> int:
        """Return the number of probes that the chosen source has."""
        return SOURCES[self.source].probes(getattr(self, self.source))

    def open_source(self) -> ProbeSource:
        """Open the source that was chosen."""
        return SOURCES[self.source].open(getattr(self, self.source), self.warm_up_days)

    @property
    def pace(self) -> float:
        """Seconds of the source's own time per second: how fast a file is played."""
        return SOURCES[self.source].pace(getattr(self, self.source))

    @property
    def has_logger(self) -> bool:
        """Whether a logger with a clock of its own reads the probes."""
        return SOURCES[self.source].has_logger

    def require(self, environment: EnvironmentParameters) -> None:
        """Refuse a source that does not tell what zero flow is to be known by.

        Raises:
            ConfigurationError: It does not.

        """
        asked = environment.radiation_below, environment.vpd_below
        told = SOURCES[self.source].tells(getattr(self, self.source))
        for limit, tells, name in zip(asked, told, ('radiation', 'vpd'), strict=True):
            if limit and not tells:
                msg = (
                    f'zero_flow_method = environment asks for {name} below {limit:g}, and the '
                    f'source {self.source} tells none: give {self.source}.{name}_column or '
                    f'{self.source}.{name}_field, or set environment.{name}_below to 0'
                )
                raise ConfigurationError(msg)
