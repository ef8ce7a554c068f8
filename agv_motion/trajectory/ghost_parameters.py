"""What the robot behind a Ghost can do, wherever it is sent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.parameters import Spec
from agv_motion.trajectory.limits import (
    BendLimit,
    LateralAcceleration,
    LinearSpeed,
    TurnRate,
    TurnStep,
    WheelSpeed,
)
from agv_motion.twist_limits import TwistLimits


@dataclass(frozen=True)
class GhostParameters(TwistLimits):
    """Limits of the robot, whatever pace a single trajectory asks for."""

    lateral_acceleration: Annotated[
        float, Spec('highest acceleration across the way, in bends', 'm/s2', (0.001, 100.0))
    ] = 0.5
    turn_acceleration: Annotated[
        float,
        Spec('ramps of the turns at the corners of a way; 0: no ramp', 'rad/s2', (0.0, 1000.0)),
    ] = 2.0
    turn_step: Annotated[
        float, Spec('largest jump of the turn rate, where curves meet', 'rad/s', (0.001, 100.0))
    ] = 0.4
    s_curve: Annotated[
        float, Spec('time over which acceleration builds up; 0 for a trapezoid', 's', (0.0, 10.0))
    ] = 0.0
    longest_way: Annotated[float, Spec('a longer trajectory is refused', 'm', (0.01, 1e6))] = 1000.0
    longest_time: Annotated[
        float, Spec('a trajectory that takes longer is refused', 's', (0.1, 1e7))
    ] = 7200.0
    most_poses: Annotated[
        int, Spec('a path of more poses is refused: it takes too long to plan', '1', (1, 5000))
    ] = 1000

    def limits(self) -> tuple[BendLimit, ...]:
        """Return what holds in the bends of a way."""
        return (
            LateralAcceleration(self.lateral_acceleration),
            WheelSpeed(self.wheel_speed, self.track),
            LinearSpeed(self.linear_speed),
            TurnRate(self.turn_rate),
            TurnStep(self.turn_step),
        )

    def spot_rate(self) -> float:
        """Return the fastest turn on the spot [rad/s], where a wheel rolls at omega b / 2."""
        return min(self.turn_rate, 2.0 * self.wheel_speed / self.track)
