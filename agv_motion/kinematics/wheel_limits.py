"""How fast the wheels of a base may roll, and how hard they may speed up and brake."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class WheelLimits:
    """Limits of every wheel; where one is met the whole twist gives way, its direction kept."""

    max_wheel_speed: Annotated[
        float, Spec('limit of every rim; above it the whole twist is scaled', 'm/s', (1e-4, 50.0))
    ] = 1.0
    max_wheel_acceleration: Annotated[
        float, Spec('limit of every rim, speeding up; 0: none', 'm/s2', (0.0, 1000.0))
    ] = 2.0
    max_wheel_deceleration: Annotated[
        float,
        Spec('limit of every rim, braking, when a twist asks for it; 0: none', 'm/s2', (0.0, 1e3)),
    ] = 4.0
    max_wheel_jerk: Annotated[
        float, Spec('most that an acceleration changes; 0: no limit', 'm/s3', (0.0, 1e6))
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row, and that a robot brakes at least as hard as it speeds up.

        Raises:
            ConfigurationError: A value is out of its range, or it does not.

        """
        check(self)
        up, down = self.max_wheel_acceleration, self.max_wheel_deceleration
        if 0.0 < down < (up or inf):
            msg = (
                f'max_wheel_deceleration = {down:g} m/s2 is below max_wheel_acceleration = '
                f'{up:g} m/s2 (0: none): a robot must brake at least as hard as it speeds up'
            )
            raise ConfigurationError(msg)

    @property
    def speeding_up(self) -> float:
        """Highest acceleration of a rim that speeds up; infinite without limit [m/s2]."""
        return self.max_wheel_acceleration or inf

    @property
    def braking(self) -> float:
        """Highest deceleration of a rim that brakes; infinite without limit [m/s2]."""
        return self.max_wheel_deceleration or inf

    @property
    def jerk(self) -> float:
        """Highest change of an acceleration; infinite without limit [m/s3]."""
        return self.max_wheel_jerk or inf
