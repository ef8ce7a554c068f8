"""A base on omnidirectional wheels: motors with lag, and encoders that slip, round and break."""

from __future__ import annotations

import random
from dataclasses import dataclass
from math import exp, sqrt
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist, integrate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.omniwheels import OmniWheels


@dataclass(frozen=True)
class OmniRobotParameters:
    """How wheels follow their commands, and how well their encoders measure."""

    traction_lag: Annotated[float, Spec('time constant of a wheel', 's', (0.0, 10.0))] = 0.1
    wheel_noise: Annotated[
        float, Spec('standard deviation of the slip of a wheel after 1 m', 'm', (0.0, 1.0))
    ] = 0.005
    encoder_resolution: Annotated[
        float, Spec('angle of one tick; 0: continuous', 'rad', (0.0, 1.0))
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class WheelEncoder:
    """What is measured of one wheel."""

    def __init__(self, radius: float) -> None:
        """Begin at zero; ``radius`` [m] is the real one of the wheel."""
        self._radius = radius
        self.gain = 1.0
        """what it measures of its wheel's motion: 1 sound, 0 dead"""
        self.angle = 0.0
        """[rad]"""

    def roll(self, travel: float) -> None:
        """Let the rim roll so far [m]."""
        self.angle += self.gain * travel / self._radius


class OmniRobot:
    """The simulated robot: its wheels, and where they have carried it."""

    def __init__(
        self,
        wheels: OmniWheels,
        wheel_radii: Sequence[float],
        parameters: OmniRobotParameters,
        pose: Pose,
        seed: int,
    ) -> None:
        """Start at rest.

        Args:
            wheels: Where the wheels really are.
            wheel_radii: (n,) their real radii [m].
            parameters: How they follow and measure.
            pose: Where the robot stands.
            seed: Of the slip.

        """
        self._wheels = wheels
        self._given = parameters
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret
        self.encoders = [WheelEncoder(radius) for radius in wheel_radii]
        """(n,) of the wheels"""
        self.speeds = [0.0] * len(wheels)
        """(n,) [m/s] rim speeds"""
        self.pose = pose
        self.twist: Twist = REST

    def angles(self) -> list[float]:
        """Return (n,) what the encoders tell [rad]."""
        tick = self._given.encoder_resolution
        turned = [encoder.angle for encoder in self.encoders]
        return turned if tick == 0.0 else [tick * round(angle / tick) for angle in turned]

    def step(self, speeds: Sequence[float], duration: float) -> None:
        """Follow commanded rim speeds (n,) [m/s] for ``duration`` [s].

        The body moves as its wheels agree on average; each wheel rolls that way and slips a
        little, by a random walk over the distance.
        """
        lag = self._given.traction_lag
        share = 1.0 - exp(-duration / lag) if lag > 0.0 else 1.0
        self.speeds = [
            now + share * (wanted - now) for now, wanted in zip(self.speeds, speeds, strict=True)
        ]
        self.twist = self._wheels.twist(self.speeds).twist
        self.pose = integrate(self.pose, self.twist, duration)
        rolling = self._wheels.command(self.twist).speed
        for encoder, speed in zip(self.encoders, rolling, strict=True):
            travel = speed * duration
            slip = self._random.gauss(0.0, self._given.wheel_noise * sqrt(abs(travel)))
            encoder.roll(travel + slip)

    def carry_to(self, pose: Pose) -> None:
        """Lift the robot and set it down elsewhere, its wheels still: kidnapping."""
        self.pose = pose
