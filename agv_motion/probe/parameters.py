"""How a probe is read: every parameter of the way from its reading to its sap flow."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.probe.calibration import CalibrationParameters
from agv_motion.probe.damping import DampingParameters
from agv_motion.probe.environment import EnvironmentParameters
from agv_motion.probe.loss import LossParameters
from agv_motion.probe.zero_flow_method import ZeroFlowMethodName


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
    ] = 2e-6
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
    zero_flow_method: Annotated[
        str,
        Spec(
            'what is zero flow: the highest reading before dawn of the last night (predawn) or of '
            'zero_flow_days nights (moving_window), the mean of the nights not below their mean '
            '(double_regression), or the last night of dark and moist air (environment)',
            choices=tuple(each.value for each in ZeroFlowMethodName),
        ),
    ] = ZeroFlowMethodName.MOVING_WINDOW.value
    zero_flow_days: Annotated[int, Spec('nights that tell zero flow', 'd', (1, 60))] = 3
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
    noise_above: Annotated[
        float,
        Spec('distance from the line through its neighbours that is noise', '1', (1e-3, 1.0)),
    ] = 0.015
    settling: Annotated[
        float,
        Spec('how long a heater that is on again warms up before it is believed', 's', (0, 86400)),
    ] = 2700.0
    needle_in_sapwood: Annotated[
        float, Spec('share of the needles that is in sapwood; the rest in heartwood', '1', (0.1, 1))
    ] = 1.0
    environment: EnvironmentParameters = field(default_factory=EnvironmentParameters)
    calibration: CalibrationParameters = field(default_factory=CalibrationParameters)
    damping: DampingParameters = field(default_factory=DampingParameters)
    loss: LossParameters = field(default_factory=LossParameters)

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
        asked = self.environment.radiation_below or self.environment.vpd_below
        if self.needs_environment and not asked:
            msg = (
                'zero_flow_method = environment asks nothing: give environment.radiation_below, '
                'environment.vpd_below or both'
            )
            raise ConfigurationError(msg)

    @property
    def needs_environment(self) -> bool:
        """Whether zero flow is known by the air round the tree."""
        return ZeroFlowMethodName(self.zero_flow_method) is ZeroFlowMethodName.ENVIRONMENT
