"""How far the wheels of a base can be trusted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class OdometryParameters:
    """Noise of the wheels, and what a plausible reading of their encoders is."""

    wheel_noise: Annotated[
        float, Spec('standard deviation of the travel of a wheel after 1 m', 'm', (1e-6, 1.0))
    ] = 0.005
    max_wheel_speed: Annotated[
        float, Spec('of the wheels on average; beyond, an encoder has jumped', 'm/s', (1e-4, 50.0))
    ] = 5.0
    max_gap: Annotated[
        float, Spec('silence after which the path between is a guess', 's', (1e-3, 3600.0))
    ] = 0.5
    gap_noise: Annotated[
        float, Spec('standard deviation of a travel over a gap, as a share of it', '1', (0.0, 10.0))
    ] = 0.3
    encoder_range: Annotated[
        float, Spec('angle at which encoders start again from 0; 0: never', 'rad', (0.0, 1e9))
    ] = 0.0

    encoder_resolution: Annotated[
        float, Spec('angle of one tick, which is no slip', 'rad', (0.0, 1.0))
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)
