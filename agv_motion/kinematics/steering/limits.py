"""What turrets and wheels can do, and when a turret is reversed rather than turned far."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi, tau
from typing import Annotated

from agv_motion.parameters import Spec, check

QUARTER_TURN_IN_SIX_SECONDS = pi / 2.0 / 6.0
"""[rad/s] The tree's turrets: no faster, to dig no trench, squeal no tyre and stay silent."""


@dataclass(frozen=True)
class SteeringLimits:
    """Limits of every turret and every wheel of one platform."""

    max_wheel_speed: Annotated[
        float,
        Spec('limit of every wheel; above it the whole twist is scaled', 'm/s', (1e-4, 10.0)),
    ] = 2.0 / 60.0
    wheel_acceleration: Annotated[
        float, Spec('most that the speed of a wheel changes', 'm/s2', (1e-3, 100.0), dynamic=True)
    ] = 0.05
    steering_rate: Annotated[
        float, Spec('fastest that a turret turns', 'rad/s', (1e-3, 100.0), dynamic=True)
    ] = QUARTER_TURN_IN_SIX_SECONDS
    steering_acceleration: Annotated[
        float,
        Spec(
            'most that the rate of a turret changes; a lower one counts once no turret turns',
            'rad/s2',
            (1e-3, 1e4),
            dynamic=True,
        ),
    ] = 1.0
    turn_limit: Annotated[
        float, Spec('how far the cables let a turret turn, either way', 'turns', (0.3, 1e6))
    ] = 1.5
    reversal_angle: Annotated[
        float,
        Spec(
            'a turret that would have to turn further is reversed: its wheel then rolls backwards',
            'rad',
            (pi / 2.0, pi),
            dynamic=True,
        ),
    ] = pi / 2.0
    reversal_hysteresis: Annotated[
        float,
        Spec('how much further before a decision is reconsidered', 'rad', (0.0, 1.0), dynamic=True),
    ] = 0.2

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @cached_property
    def cables_end(self) -> float:
        """How far the cables let a turret turn from straight, either way [rad]."""
        return self.turn_limit * tau
