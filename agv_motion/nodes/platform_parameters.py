"""The platform of the tree, as every node that needs its shape declares it."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.turrets import Turrets
from agv_motion.parameters import Spec, check

FRONT = 1.18 / sqrt(2.0)
"""[m] The two front turrets stand at -45 and +45 degrees, 1.18 m from the centre."""


@dataclass(frozen=True)
class PlatformParameters:
    """Turrets and wheels; by default the tree's octagon on three turrets."""

    turret_x: Annotated[tuple[float, ...], Spec('turret centres, forward', 'm', (-100, 100))] = (
        FRONT, FRONT, -1.18,
    )  # fmt: skip
    turret_y: Annotated[tuple[float, ...], Spec('turret centres, left', 'm', (-100, 100))] = (
        -FRONT, FRONT, 0.0,
    )  # fmt: skip
    wheel_radius: Annotated[float, Spec('rolling radius of all wheels', 'm', (0.001, 10.0))] = 0.1

    def __post_init__(self) -> None:
        """Check every row, and that each turret has both coordinates."""
        check(self)
        if len(self.turret_x) != len(self.turret_y):
            msg = (
                f'{len(self.turret_x)} values in turret_x, {len(self.turret_y)} in turret_y: '
                'give both coordinates of every turret'
            )
            raise ConfigurationError(msg)

    def turrets(self) -> Turrets:
        """Return the kinematics of this platform."""
        return Turrets(list(zip(self.turret_x, self.turret_y, strict=True)))
