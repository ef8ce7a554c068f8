"""How a robot follows its Ghost: the law, the delay, when it has arrived."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.holonomic import Holonomic, HolonomicGains
from agv_motion.trajectory.kanayama import Kanayama, KanayamaGains
from agv_motion.trajectory.leash import LeashParameters
from agv_motion.trajectory.ramsete import Ramsete, RamseteGains

if TYPE_CHECKING:
    from agv_motion.trajectory.tracking import TrackingLaw


@dataclass(frozen=True)
class FollowerParameters:
    """How the robot follows its Ghost."""

    law: Annotated[
        str, Spec('law of control', choices=('kanayama', 'ramsete', 'holonomic'), dynamic=True)
    ] = 'kanayama'
    delay: Annotated[
        float,
        Spec(
            'speeds are fed forward so much ahead: lag of motors and link',
            's',
            (0.0, 2.0),
            dynamic=True,
        ),
    ] = 0.03
    settle_speed: Annotated[
        float,
        Spec('at the end: arrived when the law asks for less', 'm/s', (0.0, 1.0), dynamic=True),
    ] = 0.02
    settle_turn: Annotated[
        float, Spec('... and for less of a turn', 'rad/s', (0.0, 1.0), dynamic=True)
    ] = 0.04
    settle_time: Annotated[
        float,
        Spec('it has arrived as well as it can after so long', 's', (0.0, 60.0), dynamic=True),
    ] = 1.0
    kanayama: KanayamaGains = field(default_factory=KanayamaGains)
    ramsete: RamseteGains = field(default_factory=RamseteGains)
    holonomic: HolonomicGains = field(default_factory=HolonomicGains)
    leash: LeashParameters = field(default_factory=LeashParameters)
    ghost: GhostParameters = field(default_factory=GhostParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def make_law(self) -> TrackingLaw:
        """Return the law that is chosen."""
        if self.law == 'kanayama':
            return Kanayama(self.kanayama)
        return Ramsete(self.ramsete) if self.law == 'ramsete' else Holonomic(self.holonomic)
