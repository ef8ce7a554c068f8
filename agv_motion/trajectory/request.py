"""How a trajectory is to be gone: pace, shape and sense."""

from __future__ import annotations

from dataclasses import dataclass

from agv_motion.trajectory.bounds import SPEEDS, require_between, require_ramp


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

    @classmethod
    def of_turn(cls, ramps: float, rate: float) -> Request:
        """Return what is asked of a turn on the spot.

        Args:
            ramps: [rad/s2] speeding up and braking; `NO_RAMP`: at once.
            rate: [rad/s]

        Raises:
            ConfigurationError: One of them is out of its range.

        """
        require_ramp('ramps of a turn', ramps, 'rad/s2')
        require_between('rate of a turn', rate, SPEEDS, 'rad/s')
        return cls(ramps, rate)

    @property
    def acceleration(self) -> float:
        """Of the ramps [m/s2]; as good as without end where there are none."""
        return require_ramp('speed_ramps', self.speed_ramps)
