"""A gyroscope about the upright axis: white noise and a bias, seeded."""

from __future__ import annotations

import random
from dataclasses import dataclass
from math import sqrt
from typing import Annotated

from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class GyroParameters:
    """How good the simulated gyroscope is."""

    noise: Annotated[float, Spec('standard deviation of the turn after 1 s', 'rad', (0.0, 1.0))] = (
        0.002
    )
    bias: Annotated[float, Spec('what it tells at rest', 'rad/s', (-1.0, 1.0))] = 0.01

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Gyro:
    """Measures a true yaw rate."""

    def __init__(self, parameters: GyroParameters, seed: int) -> None:
        """Start the sequence of noise that belongs to ``seed``."""
        self._given = parameters
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret

    def measure(self, rate: float, duration: float) -> float:
        """Return the mean measured rate [rad/s] over ``duration`` [s] of a true one."""
        spread = self._given.noise / sqrt(duration)
        return rate + self._given.bias + self._random.gauss(0.0, spread)
