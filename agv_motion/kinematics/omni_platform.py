"""The omnidirectional base, as every node that needs its shape declares it."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class OmniBaseParameters:
    """Places, directions and radii of the wheels; by default three at 30, 150 and 270 degrees."""

    wheel_angles: Annotated[
        tuple[float, ...], Spec('where each wheel stands, from the x axis', 'rad', (-7.0, 7.0))
    ] = (pi / 6, 5 * pi / 6, -pi / 2)
    wheel_distances: Annotated[
        tuple[float, ...], Spec('of each wheel from the centre', 'm', (0.0, 100.0))
    ] = (0.2, 0.2, 0.2)
    wheel_directions: Annotated[
        tuple[float, ...],
        Spec('in which the motor of each wheel drives, from the x axis', 'rad', (-7.0, 7.0)),
    ] = (-pi / 3, pi / 3, -pi)
    slide_angles: Annotated[
        tuple[float, ...],
        Spec(
            'from there to the direction that the rollers leave free: pi/2 omni, +-pi/4 mecanum',
            'rad',
            (-7.0, 7.0),
        ),
    ] = (pi / 2, pi / 2, pi / 2)
    wheel_radii: Annotated[tuple[float, ...], Spec('of each wheel', 'm', (0.001, 10.0))] = (
        0.05, 0.05, 0.05,
    )  # fmt: skip
    joint_names: Annotated[tuple[str, ...], Spec('of the wheels, in their order')] = (
        'wheel_0', 'wheel_1', 'wheel_2',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Check every row, and that each wheel has all that a wheel has."""
        check(self)
        rows = ('wheel_angles', 'wheel_distances', 'wheel_directions', 'slide_angles',
                'wheel_radii', 'joint_names')  # fmt: skip
        counts = {name: len(getattr(self, name)) for name in rows}
        if len(set(counts.values())) > 1:
            given = ', '.join(f'{count} {name}' for name, count in counts.items())
            msg = f'{given}: give all six of every wheel'
            raise ConfigurationError(msg)
        if len(set(self.joint_names)) < len(self.joint_names):
            msg = f'joint_names = {list(self.joint_names)}: two wheels bear the same name'
            raise ConfigurationError(msg)
