"""Parameters that several nodes share: how fresh inputs have to be, and what a driven base is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.model.frames import FrameParameters
from agv_motion.parameters import Spec
from agv_motion.ros.input_watch import Freshness


@dataclass(frozen=True)
class InputParameters:
    """How fresh the inputs of a node have to be."""

    report_after: Annotated[
        float, Spec('how long an input may be silent before that is told', 's', (0.01, 3600.0))
    ] = 0.5
    stop_after: Annotated[
        float, Spec('how long an input may be silent before the robot stops', 's', (0.01, 3600.0))
    ] = 1.0
    max_age: Annotated[
        float, Spec('how far the stamps of inputs may lie from now, either way', 's', (0.01, 1e10))
    ] = 1.0

    def freshness(self) -> Freshness:
        """Return the limits of each input."""
        return Freshness(self.report_after, self.stop_after, self.max_age)


@dataclass(frozen=True)
class CommandParameters(InputParameters, FrameParameters):
    """What `cmd_vel` is like, beside what the inputs are."""

    stamped: Annotated[bool, Spec('cmd_vel is TwistStamped (else Twist)')] = True


@dataclass(frozen=True)
class DrivenParameters(CommandParameters):
    """What nodes share that drive wheels and tell by their encoders how far they came."""

    odom_frame: Annotated[str, Spec('frame in which the wheels carry the robot')] = 'odom'
