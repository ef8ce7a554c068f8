"""What the robot behind a Ghost can do, wherever it is sent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.parameters import Spec, check
from agv_motion.trajectory.limits import LateralAcceleration, Limit, TurnRate, TurnStep, WheelSpeed


@dataclass(frozen=True)
class GhostParameters:
    """Limits of the robot, whatever pace a single trajectory asks for."""

    track: Annotated[float, Spec('distance between the wheels', 'm', (0.001, 100.0))] = 0.3
    wheel_speed: Annotated[float, Spec('fastest a wheel may roll', 'm/s', (0.001, 100.0))] = 1.0
    lateral_acceleration: Annotated[
        float, Spec('highest acceleration across the way, in bends', 'm/s2', (0.001, 100.0))
    ] = 0.5
    turn_rate: Annotated[float, Spec('fastest the robot may turn', 'rad/s', (0.001, 100.0))] = 2.0
    turn_acceleration: Annotated[
        float, Spec('ramps of the turns at the corners of a way', 'rad/s2', (0.001, 1000.0))
    ] = 2.0
    turn_step: Annotated[
        float, Spec('largest jump of the turn rate, where curves meet', 'rad/s', (0.001, 100.0))
    ] = 0.4
    s_curve: Annotated[
        float, Spec('time over which acceleration builds up; 0 for a trapezoid', 's', (0.0, 10.0))
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def limits(self) -> tuple[Limit, ...]:
        """Return what holds in the bends of a way."""
        return (
            LateralAcceleration(self.lateral_acceleration),
            WheelSpeed(self.wheel_speed, self.track),
            TurnRate(self.turn_rate),
            TurnStep(self.turn_step),
        )

    def spot_rate(self) -> float:
        """Return the fastest turn on the spot [rad/s], where a wheel rolls at omega b / 2."""
        return min(self.turn_rate, 2.0 * self.wheel_speed / self.track)
