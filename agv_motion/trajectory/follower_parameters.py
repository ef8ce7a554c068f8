"""How a robot follows its Ghost: the law, the delay, when it has arrived."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Any

from agv_motion.parameters import Spec, check
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.holonomic import Holonomic, HolonomicGains
from agv_motion.trajectory.kanayama import Kanayama, KanayamaGains
from agv_motion.trajectory.pace import PaceParameters
from agv_motion.trajectory.ramsete import Ramsete, RamseteGains

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.trajectory.tracking import TrackingLaw

LAWS: dict[str, Callable[[Any], TrackingLaw]] = {
    'kanayama': Kanayama,
    'ramsete': Ramsete,
    'holonomic': Holonomic,
}
"""A law is added here, as a group of its name in `FollowerParameters`, and in its own file."""


@dataclass(frozen=True)
class FollowerParameters:
    """How the robot follows its Ghost."""

    law: Annotated[str, Spec('law of control', choices=tuple(LAWS), dynamic=True)] = 'kanayama'
    delay: Annotated[
        float,
        Spec(
            'how far ahead speeds are fed forward: lag of motors and link',
            's',
            (0.0, 2.0),
            dynamic=True,
        ),
    ] = 0.03
    tolerance: Annotated[
        float,
        Spec('it has arrived no further than this from the goal', 'm', (1e-4, 10.0), dynamic=True),
    ] = 0.03
    heading_tolerance: Annotated[
        float, Spec('... and turned from it no more than this', 'rad', (1e-4, 3.2), dynamic=True)
    ] = 0.06
    settle_speed: Annotated[
        float,
        Spec('within these, it need not wait when the law asks for less', 'm/s', (0.0, 1.0),
             dynamic=True),
    ] = 0.02  # fmt: skip
    settle_turn: Annotated[
        float, Spec('... and for less of a turn', 'rad/s', (0.0, 1.0), dynamic=True)
    ] = 0.04
    settle_time: Annotated[
        float,
        Spec('time without coming nearer after which it is as near as the law brings it', 's',
             (0.0, 60.0), dynamic=True),
    ] = 1.0  # fmt: skip
    corrections: Annotated[
        int,
        Spec(
            'number of times that it then drives the last stretch anew, before it has failed; '
            'none with the holonomic law', '1', (0, 100), dynamic=True,
        ),
    ] = 2  # fmt: skip
    kanayama: KanayamaGains = field(default_factory=KanayamaGains)
    ramsete: RamseteGains = field(default_factory=RamseteGains)
    holonomic: HolonomicGains = field(default_factory=HolonomicGains)
    pace: PaceParameters = field(default_factory=PaceParameters)
    ghost: GhostParameters = field(default_factory=GhostParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def on_track(self, track: float) -> FollowerParameters:
        """Return the same for a robot whose wheels stand ``track`` [m] apart."""
        return replace(self, ghost=replace(self.ghost, track=track))

    def make_law(self) -> TrackingLaw:
        """Return the law that is chosen."""
        return LAWS[self.law](getattr(self, self.law))
