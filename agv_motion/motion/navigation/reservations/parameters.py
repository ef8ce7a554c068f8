"""How trees share a zone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.parameters import Spec, check


@dataclass(frozen=True)
class TrafficParameters:
    """How a tree shares a zone; body, margin and tolerance may differ between trees."""

    body: float = PLATFORM_RADIUS
    """[m] rim of the tree from its centre; no parameter: the outline of the platform tells it"""
    margin: Annotated[float, Spec('between the rims of two trees, at least', 'm', (0.0, 10.0))] = (
        0.2
    )
    tolerance: Annotated[
        float,
        Spec('largest distance of a tree from its path: errors of position', 'm', (0.01, 10.0)),
    ] = 0.3
    silent_after: Annotated[
        float,
        Spec('time after which a tree not heard is silent: keep off its side', 's', (1.0, 3600.0)),
    ] = 30.0
    listen: Annotated[
        float, Spec('time to listen who is there before the first move', 's', (0.0, 3600.0))
    ] = 5.0
    expected: Annotated[
        tuple[str, ...], Spec('trees that must have been heard before the first move')
    ] = ()
    patience: Annotated[
        float, Spec('time after which a blocked tree looks for another goal', 's', (10.0, 1200.0))
    ] = 120.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @property
    def radius(self) -> float:
        """Of the disc about its supposed centre that a tree may occupy [m]."""
        return self.body + self.tolerance

    @property
    def clearance(self) -> float:
        """Distance that the supposed centres of two such trees keep [m]."""
        return 2.0 * self.radius + self.margin
