"""Parameters of `wheel_kinematics`: the platform, its limits, and what makes it stop."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.nodes.input_parameters import DrivenParameters
from agv_motion.parameters import Spec


@dataclass(frozen=True)
class WheelKinematicsParameters(DrivenParameters, PlatformParameters, SteeringLimits):
    """The platform, its limits, and what makes it stop."""

    rate: Annotated[float, Spec('commands per second, at least', 'Hz', (1.0, 1000.0))] = 20.0
    steering_zero: Annotated[
        tuple[float, ...],
        Spec(
            'what each steering angle reads too little, from a calibration; empty: nothing',
            'rad',
            (-pi, pi),
        ),
    ] = ()
    wheel_noise: Annotated[
        float, Spec('standard deviation of the travel of a wheel after 1 m', 'm', (1e-6, 1.0))
    ] = 0.02
    max_measured_speed: Annotated[
        float, Spec('measured speed of a wheel beyond which a state is refused', 'm/s', (1e-3, 100))
    ] = 10.0
    max_gap: Annotated[
        float,
        Spec(
            'silence of turrets/state over which nobody knows what they rolled', 's', (1e-3, 10.0)
        ),
    ] = 0.5
    unwind_after: Annotated[
        float,
        Spec('rest after which turned cables are unwound; 0: never by itself', 's', (0.0, 1e6)),
    ] = 60.0
    report_after: float = 3.0
    stop_after: float = 5.0
    max_age: float = 5.0
    residual_warning: Annotated[
        float, Spec('turrets fight: warn above', 'm/s', (0.0, 10.0), dynamic=True)
    ] = 0.005
    residual_stop: Annotated[
        float, Spec('turrets fight: stop above', 'm/s', (0.0, 10.0), dynamic=True)
    ] = 0.02

    def __post_init__(self) -> None:
        """Check every row, and that the warning comes before the stop."""
        super().__post_init__()
        if self.residual_warning > self.residual_stop:
            msg = (
                f'residual_warning = {self.residual_warning} m/s is above '
                f'residual_stop = {self.residual_stop} m/s: warn before stopping'
            )
            raise ConfigurationError(msg)
        if len(self.steering_zero) not in {0, len(self.turret_x)}:
            msg = (
                f'steering_zero = {list(self.steering_zero)}: give one for each of '
                f'{len(self.turret_x)} turrets, or none'
            )
            raise ConfigurationError(msg)

    def zeros(self) -> tuple[float, ...]:
        """Return what each steering angle reads too little [rad]."""
        return self.steering_zero or (0.0,) * len(self.turret_x)
