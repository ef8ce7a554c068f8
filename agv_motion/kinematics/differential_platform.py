"""The differential base, as every node that needs its shape declares it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class TrackParameters:
    """How wide the robot stands: all that a node needs that drives it but not its wheels."""

    track: Annotated[float, Spec('distance between the wheels', 'm', (0.001, 100.0))] = 0.3
    track_multiplier: Annotated[
        float, Spec('effective track over measured track, from a calibration', '1', (0.5, 2.0))
    ] = 1.0

    @property
    def effective_track(self) -> float:
        """By which the wheels turn the robot [m]."""
        return self.track * self.track_multiplier


@dataclass(frozen=True)
class DifferentialBaseParameters(TrackParameters):
    """Track and radii of two wheels, left and right."""

    wheel_radii: Annotated[tuple[float, ...], Spec('left and right', 'm', (0.001, 10.0))] = (
        0.05, 0.05,
    )  # fmt: skip
    joint_names: Annotated[tuple[str, ...], Spec('left and right')] = (
        'left_wheel', 'right_wheel',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Check every row, and that there are two wheels with names of their own."""
        check(self)
        for name in ('wheel_radii', 'joint_names'):
            values = getattr(self, name)
            if len(values) != 2:
                msg = f'{name} = {list(values)}: give two, left and right'
                raise ConfigurationError(msg)
        if self.joint_names[0] == self.joint_names[1]:
            msg = f'joint_names = {list(self.joint_names)}: two wheels bear the same name'
            raise ConfigurationError(msg)
