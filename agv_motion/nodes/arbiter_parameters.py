"""Parameters of `arbiter`: how long each source counts, and the limits of the whole robot."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from agv_motion.arbitration.chassis_limits import ChassisLimitParameters
from agv_motion.arbitration.source import DRIVERS, TwistSource
from agv_motion.model.frames import FrameParameters
from agv_motion.parameters import Spec, check
from agv_motion.ros.input_watch import Freshness

TIMES = (0.05, 60.0)
"""[s]"""


@dataclass(frozen=True)
class TimeoutParameters:
    """Silence after which a source counts no more."""

    manual: Annotated[
        float, Spec('silence of a person after which the wheels stand: the dead-man', 's', TIMES)
    ] = 0.3
    page: Annotated[float, Spec('silence of page after which others drive', 's', TIMES)] = 0.5
    route: Annotated[float, Spec('silence of route after which others drive', 's', TIMES)] = 0.5
    sequence: Annotated[float, Spec('silence of sequence after which others drive', 's', TIMES)] = (
        0.5
    )
    agent: Annotated[float, Spec('silence of agent after which nobody drives', 's', TIMES)] = 1.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def of(self, source: TwistSource) -> float:
        """Return the time-out of a driver [s]."""
        return float(getattr(self, source.value))


@dataclass(frozen=True)
class ArbiterParameters(FrameParameters):
    """Who counts for how long, and how fast the robot may move at all."""

    rate: Annotated[
        float,
        Spec('commands per second, at least; what a driver says is passed on at once', 'Hz',
             (1.0, 1000.0)),
    ] = 10.0  # fmt: skip
    max_age: Annotated[
        float,
        Spec('how far stamps may lie from now, either way; of manual no more than its time-out',
             's', (0.01, 1e10)),
    ] = 1.0  # fmt: skip
    stamped: Annotated[bool, Spec('cmd_vel and what comes in are TwistStamped (else Twist)')] = True
    state_file: Annotated[
        str, Spec('where to keep STOP and locks over a restart; empty: nowhere')
    ] = ''
    timeouts: TimeoutParameters = field(default_factory=TimeoutParameters)
    limits: ChassisLimitParameters = field(default_factory=ChassisLimitParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def freshness(self, source: TwistSource) -> Freshness:
        """Return which stamps of a source are news.

        The silence of all is that of the most patient: a clock that stands for less is none.
        """
        patience = max(map(self.timeouts.of, DRIVERS))
        manual = source is TwistSource.MANUAL
        age = min(self.max_age, self.timeouts.manual) if manual else self.max_age
        return Freshness(patience, patience, age)
