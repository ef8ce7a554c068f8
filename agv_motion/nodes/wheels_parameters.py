"""What nodes have to be told that drive fixed wheels."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from agv_motion.blocked import BlockedParameters
from agv_motion.kinematics.wheel_limits import WheelLimits
from agv_motion.nodes.input_parameters import DrivenParameters
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.parameters import Spec


@dataclass(frozen=True)
class WheelsParameters(DrivenParameters, WheelLimits):
    """The limits of the wheels, what makes them stop, and how far their encoders are trusted."""

    rate: Annotated[
        float, Spec('commands per second while the speed changes', 'Hz', (1.0, 1000.0))
    ] = 50.0
    report_after: float = 0.3
    stop_after: float = 0.5
    blocked: BlockedParameters = field(default_factory=BlockedParameters)
    odometry: OdometryParameters = field(default_factory=OdometryParameters)
