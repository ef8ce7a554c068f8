"""Parameters of nodes that drive a robot by its pose."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated

from agv_motion.blocked import BlockedParameters
from agv_motion.kinematics.differential_platform import TrackParameters
from agv_motion.nodes.input_parameters import CommandParameters
from agv_motion.parameters import Spec, check


class PoseTopic(Enum):
    """The topic that tells where the robot is."""

    ODOM = 'odom'
    """nav_msgs/Odometry of its wheels, which drifts"""
    POSE = 'pose'
    """PoseWithCovarianceStamped of its localisation"""


@dataclass(frozen=True)
class DrivingParameters(CommandParameters, TrackParameters):
    """How often to command, and whom to believe where the robot is."""

    rate: Annotated[float, Spec('commands per second', 'Hz', (0.1, 1000.0))] = 20.0
    position: Annotated[
        str,
        Spec(
            'where the pose comes from: topic odom, or topic pose',
            choices=tuple(each.value for each in PoseTopic),
        ),
    ] = PoseTopic.ODOM.value
    frame: Annotated[
        str,
        Spec(
            'frame of the pose, and of all that is to be driven; that of odom gets the prefix, '
            'that of pose does not'
        ),
    ] = 'odom'
    blocked: BlockedParameters = field(default_factory=BlockedParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @property
    def drives_by_odom(self) -> bool:
        """Whether `frame` is that of the robot's own odometry, rather than one of all robots."""
        return PoseTopic(self.position) is PoseTopic.ODOM

    def named(self, frame: str) -> str:
        """Return a frame that was told as `frame` is on the graph."""
        return self.own(frame) if self.drives_by_odom else frame.lstrip('/')

    def own_names(self) -> tuple[str, ...]:
        """Return which parameters name frames of the robot itself."""
        return (*super().own_names(), *(['frame'] * self.drives_by_odom))

    def shared_names(self) -> tuple[str, ...]:
        """Return which parameters name frames of all robots."""
        return (*super().shared_names(), *(['frame'] * (not self.drives_by_odom)))
