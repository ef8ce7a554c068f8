"""How a trajectory is to be gone: pace, shape and sense."""

from __future__ import annotations

from dataclasses import dataclass

from agv_motion.trajectory.limits import require_between
from agv_motion.trajectory.speed_plan import AT_ONCE

NO_RAMP = 0.0
"""[m/s2], [rad/s2] In the place of an acceleration: the speed changes at once, nothing is ramped.

What the motors do of it is for the limits of the base to say."""

SPEEDS = (1e-9, 1e6)
"""[m/s], [rad/s] A speed beyond cannot be meant."""

RAMPS = (1e-9, AT_ONCE)
"""[m/s2], [rad/s2] Likewise a ramp."""


def require_ramp(name: str, value: float) -> float:
    """Return the acceleration of a ramp [m/s2]: ``value``, or of `NO_RAMP` one without end.

    Raises:
        ConfigurationError: It is negative, not finite or too small.

    """
    if value == NO_RAMP:
        return AT_ONCE
    return require_between(name, value, RAMPS, 'm/s2', 'for no ramp give 0 (NO_RAMP)')


@dataclass(frozen=True)
class Request:
    """What is asked of a trajectory beside its goals.

    Raises:
        ConfigurationError: A number is out of its range.

    """

    speed_ramps: float
    """[m/s2] speeding up and braking; [rad/s2] of a pure rotation; `NO_RAMP`: at once"""
    cruising_speed: float
    """[m/s]; [rad/s] of a pure rotation"""
    delta_curve: float = 0.0
    """Length of the handles of the curves, as a share of the distance; 0 for straight lines"""
    backward: bool = False
    """Whether the robot looks against its way"""

    def __post_init__(self) -> None:
        """Check every number."""
        require_ramp('speed_ramps', self.speed_ramps)
        require_between('cruising_speed', self.cruising_speed, SPEEDS, 'm/s')
        require_between('delta_curve', self.delta_curve, (0.0, 5.0), '', '0.3 to 0.6 is usual')

    @property
    def acceleration(self) -> float:
        """Of the ramps [m/s2]; as good as without end where there are none."""
        return require_ramp('speed_ramps', self.speed_ramps)
