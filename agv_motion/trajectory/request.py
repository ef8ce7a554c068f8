"""How a trajectory is to be gone: pace, shape and sense."""

from __future__ import annotations

from dataclasses import dataclass

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory.limits import require_positive


@dataclass(frozen=True)
class Request:
    """What is asked of a trajectory beside its goals.

    Raises:
        ConfigurationError: A number is out of its range.

    """

    speed_ramps: float
    """[m/s2] speeding up and braking; [rad/s2] of a pure rotation"""
    cruising_speed: float
    """[m/s]; [rad/s] of a pure rotation"""
    delta_curve: float = 0.0
    """Length of the handles of the curves, as a share of the distance; 0 for straight lines"""
    backward: bool = False
    """Whether the robot looks against its way"""

    def __post_init__(self) -> None:
        """Check every number."""
        require_positive('speed_ramps', self.speed_ramps, 'm/s2')
        require_positive('cruising_speed', self.cruising_speed, 'm/s')
        if not 0.0 <= self.delta_curve <= 5.0:
            msg = f'delta_curve = {self.delta_curve}: must lie in [0, 5]; 0.3 to 0.6 is usual'
            raise ConfigurationError(msg)
