"""Position fixes with the noise of a radio localisation (UWB): about 15 cm, seeded."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose, wrap


@dataclass(frozen=True)
class FixParameters:
    """How good the position fixes are."""

    rate: Annotated[float, Spec('position fixes per simulated second', 'Hz', (0.01, 100.0))] = 1.0
    position_noise: Annotated[float, Spec('standard deviation of x and of y', 'm', (0.0, 10.0))] = (
        0.15
    )
    heading_noise: Annotated[
        float, Spec('standard deviation of the heading', 'rad', (0.0, 3.2))
    ] = 0.03

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class FixSensor:
    """Measures a true pose with white noise from a seed."""

    def __init__(self, parameters: FixParameters, seed: int) -> None:
        """Start the sequence of noise that belongs to ``seed``."""
        self._parameters = parameters
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret

    def measure(self, pose: Pose) -> Pose:
        """Return ``pose`` as the localisation sees it."""
        gauss, given = self._random.gauss, self._parameters
        return Pose(
            pose.x + gauss(0.0, given.position_noise),
            pose.y + gauss(0.0, given.position_noise),
            wrap(pose.theta + gauss(0.0, given.heading_noise)),
        )

    def covariance(self) -> list[float]:
        """Return the 36 numbers of a ROS pose covariance: x, y and heading; the rest unknown."""
        given = self._parameters
        covariance = [0.0] * 36
        covariance[0] = covariance[7] = given.position_noise**2
        covariance[35] = given.heading_noise**2
        return covariance
