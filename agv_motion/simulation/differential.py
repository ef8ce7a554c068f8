"""A differential drive: motors with lag, wheels that slip, encoders that count ticks."""

from __future__ import annotations

import random
from dataclasses import dataclass
from math import exp, sqrt
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist, integrate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.differential import DifferentialDrive


@dataclass(frozen=True)
class DifferentialRobotParameters:
    """How wheels follow their commands, what they lose, and how well encoders measure."""

    traction_lag: Annotated[float, Spec('time constant of a motor', 's', (0.0, 10.0))] = 0.02
    slip_left: Annotated[
        float, Spec('share of its travel that the left wheel spins in vain', '1', (-0.5, 0.5))
    ] = 0.0
    slip_right: Annotated[float, Spec('... the right wheel', '1', (-0.5, 0.5))] = 0.0
    slip_noise: Annotated[
        float, Spec('standard deviation of further slip after 1 m', 'm', (0.0, 1.0))
    ] = 0.005
    encoder_resolution: Annotated[
        float, Spec('angle of one tick; 0: continuous', 'rad', (0.0, 1.0))
    ] = 0.003

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class DifferentialRobot:
    """The simulated robot: its motors, its wheels, and where they have carried it."""

    def __init__(
        self,
        drive: DifferentialDrive,
        parameters: DifferentialRobotParameters,
        pose: Pose,
        seed: int,
    ) -> None:
        """Start at rest.

        Args:
            drive: What the robot really measures.
            parameters: How it follows and measures.
            pose: Where it stands.
            seed: Of the slip.

        """
        self._drive = drive
        self._given = parameters
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret
        self._turned = [0.0, 0.0]
        self.speeds = [0.0, 0.0]
        """(2,) [m/s] rim speeds, left and right"""
        self.pose = pose
        self.twist: Twist = REST

    def angles(self) -> list[float]:
        """Return (2,) what the encoders tell [rad]: what the wheels turned, slip and all."""
        tick = self._given.encoder_resolution
        if tick == 0.0:
            return list(self._turned)
        return [tick * round(angle / tick) for angle in self._turned]

    def step(self, speeds: Sequence[float], duration: float) -> None:
        """Follow commanded rim speeds (2,) [m/s] for ``duration`` [s].

        Each motor closes the share ``1 - exp(-duration / lag)`` of its error, and its wheel rolls
        what that is in the mean; the floor gets that less the slip.
        """
        given, drive = self._given, self._drive
        lag = given.traction_lag
        share = 1.0 - exp(-duration / lag) if lag > 0.0 else 1.0
        travels = []
        slips = given.slip_left, given.slip_right
        for i, (wanted, radius, slip) in enumerate(zip(speeds, drive.radii, slips, strict=True)):
            gap = self.speeds[i] - wanted
            rolled = wanted * duration + gap * lag * share  # the integral of the exponential
            self.speeds[i] = wanted + gap * (1.0 - share)
            self._turned[i] += rolled / radius
            noise = self._random.gauss(0.0, given.slip_noise * sqrt(abs(rolled)))
            travels.append(rolled * (1.0 - slip) + noise)
        displacement = drive.twist(travels)
        self.pose = integrate(self.pose, displacement, 1.0)
        self.twist = Twist(*(part / duration for part in displacement))

    def carry_to(self, pose: Pose) -> None:
        """Lift the robot and set it down elsewhere, its wheels still: kidnapping."""
        self.pose = pose
