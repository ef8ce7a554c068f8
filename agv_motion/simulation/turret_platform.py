"""A platform on turrets with the lags of real motors: what the wheels do of what they are told."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist, integrate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.turrets import Turrets


@dataclass(frozen=True)
class MotorParameters:
    """How turrets and wheels follow their commands."""

    steering_rate: Annotated[float, Spec('fastest a turret turns', 'rad/s', (0.01, 50.0))] = 0.4
    steering_lag: Annotated[float, Spec('time constant of a turret', 's', (0.0, 10.0))] = 0.1
    traction_lag: Annotated[float, Spec('time constant of a wheel', 's', (0.0, 10.0))] = 0.2

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class TurretPlatform:
    """The simulated platform: its turrets, its wheels and where they have carried it."""

    def __init__(self, turrets: Turrets, motors: MotorParameters, pose: Pose) -> None:
        """Start at rest with all turrets straight."""
        self._turrets = turrets
        self._motors = motors
        self.angles = [0.0] * len(turrets)
        self.speeds = [0.0] * len(turrets)
        self.pose = pose
        self.twist: Twist = REST

    def step(self, angles: Sequence[float], speeds: Sequence[float], duration: float) -> None:
        """Follow commands for ``duration`` [s]; the body moves as its wheels agree on average.

        Each motor closes the share ``1 - exp(-duration / lag)`` of its error, a turret no faster
        than its rate.

        Args:
            angles: (n,) commanded steering angles [rad].
            speeds: (n,) commanded wheel speeds [m/s].
            duration: Time step [s].

        """
        before = self._turrets.twist(self.angles, self.speeds).twist
        steering = _share(duration, self._motors.steering_lag)
        traction = _share(duration, self._motors.traction_lag)
        reach = self._motors.steering_rate * duration
        self.angles = [
            now + min(max(steering * (wanted - now), -reach), reach)
            for now, wanted in zip(self.angles, angles, strict=True)
        ]
        self.speeds = [
            now + traction * (wanted - now) for now, wanted in zip(self.speeds, speeds, strict=True)
        ]
        after = self._turrets.twist(self.angles, self.speeds).twist
        self.twist = Twist(*((a + b) / 2.0 for a, b in zip(before, after, strict=True)))
        self.pose = integrate(self.pose, self.twist, duration)

    def carry_to(self, pose: Pose) -> None:
        """Lift the platform and set it down elsewhere, its turrets and wheels as they are."""
        self.pose = pose


def _share(duration: float, lag: float) -> float:
    return 1.0 - exp(-duration / lag) if lag > 0.0 else 1.0
