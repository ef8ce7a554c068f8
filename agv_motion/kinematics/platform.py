"""The platform of the tree: where its turrets stand and how far its body reaches, told once.

All that needs its shape declares these parameters or is handed `PlatformOutline.rim`: the wheels,
the simulator, the command, the zone, the traffic of several trees, the memory and the pictures.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check

PLATFORM_RADIUS = 1.18
"""[m] from the centre to each turret of the tree. Its octagon has its corners over the turrets, so
none of it reaches further: it may be turned at will within the disc of this radius."""

FRONT = PLATFORM_RADIUS / sqrt(2.0)
"""[m] The two front turrets stand at -45 and +45 degrees."""

SMALLEST = 0.01
"""[m] No platform is smaller."""

ROUNDING = 1e-6
"""[m]"""


@dataclass(frozen=True)
class PlatformOutline:
    """Where the turrets stand and how far the body reaches; by default the tree's octagon."""

    turret_x: Annotated[tuple[float, ...], Spec('turret centres, forward', 'm', (-100, 100))] = (
        FRONT, FRONT, -PLATFORM_RADIUS,
    )  # fmt: skip
    turret_y: Annotated[tuple[float, ...], Spec('turret centres, left', 'm', (-100, 100))] = (
        -FRONT, FRONT, 0.0,
    )  # fmt: skip
    platform_radius: Annotated[
        float,
        Spec(
            'rim: no part of the platform reaches further from its centre; 0: the farthest turret',
            'm',
            (0.0, 100.0),
        ),
    ] = 0.0

    def __post_init__(self) -> None:
        """Check every row, and that each turret has both coordinates."""
        check(self)
        if len(self.turret_x) != len(self.turret_y):
            msg = (
                f'{len(self.turret_x)} values in turret_x, {len(self.turret_y)} in turret_y: '
                'give both coordinates of every turret'
            )
            raise ConfigurationError(msg)
        if self.rim < SMALLEST:
            msg = (
                f'the rim is {self.rim:g} m from the centre: give platform_radius, >= {SMALLEST} m'
            )
            raise ConfigurationError(msg)

    @property
    def rim(self) -> float:
        """How far the platform reaches from its centre, whatever its heading [m]."""
        return self.platform_radius or self.farthest

    @property
    def farthest(self) -> float:
        """How far the farthest turret stands from the centre [m]."""
        return max(map(hypot, self.turret_x, self.turret_y), default=PLATFORM_RADIUS)


@dataclass(frozen=True)
class PlatformParameters(PlatformOutline):
    """The outline and what rolls under it."""

    wheel_radius: Annotated[float, Spec('rolling radius of all wheels', 'm', (0.001, 10.0))] = 0.1

    def turret_positions(self) -> list[tuple[float, float]]:
        """Return the (n, 2) centres of the turrets [m].

        Raises:
            ConfigurationError: A turret stands outside the rim.

        """
        if self.farthest > self.rim + ROUNDING:
            msg = (
                f'a turret stands {self.farthest:g} m from the centre, outside platform_radius = '
                f'{self.rim:g} m: give the rim of the whole platform, or 0'
            )
            raise ConfigurationError(msg)
        return list(zip(self.turret_x, self.turret_y, strict=True))
