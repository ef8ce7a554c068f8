"""What a robot stands on, for nodes that draw it: any of the three platforms, by one table."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any

from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.kinematics.omni_platform import OmniBaseParameters
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.frames import FrameParameters
from agv_motion.model.robots import differential_model, omni_model, tree_model
from agv_motion.parameters import Spec, check, rows

if TYPE_CHECKING:
    from agv_motion.model.robot_model import RobotModel

STEERING = '_steering'
"""End of the name of a joint that turns a turret"""


class Platform(Enum):
    """What the robot stands on."""

    TREE = 'tree'
    OMNI = 'omni'
    DIFFERENTIAL = 'differential'


BASES: dict[Platform, Any] = {
    Platform.TREE: PlatformParameters,
    Platform.OMNI: OmniBaseParameters,
    Platform.DIFFERENTIAL: DifferentialBaseParameters,
}
MODELS: dict[Platform, Any] = {
    Platform.TREE: tree_model,
    Platform.OMNI: omni_model,
    Platform.DIFFERENTIAL: differential_model,
}

Numbers = tuple[float, ...]
Texts = tuple[str, ...]


@dataclass(frozen=True)
class RobotPlatformParameters(FrameParameters):
    """The platform, as the nodes that drive its wheels have it; what is empty is theirs, too."""

    platform: Annotated[
        str,
        Spec('what the robot stands on: turrets, omni wheels, or two wheels',
             choices=tuple(each.value for each in Platform)),
    ] = Platform.TREE.value  # fmt: skip
    turret_x: Annotated[Numbers, Spec('turret centres, forward', 'm', (-100, 100))] = ()
    turret_y: Annotated[Numbers, Spec('turret centres, left', 'm', (-100, 100))] = ()
    platform_radius: Annotated[
        float, Spec('rim of the platform; 0: the farthest turret', 'm', (0.0, 100.0))
    ] = 0.0
    wheel_radius: Annotated[
        float, Spec('rolling radius of all wheels under turrets', 'm', (0.001, 10.0))
    ] = PlatformParameters.wheel_radius
    wheel_angles: Annotated[
        Numbers, Spec('where each omni wheel stands, from the x axis', 'rad', (-7.0, 7.0))
    ] = ()
    wheel_distances: Annotated[
        Numbers, Spec('of each omni wheel from the centre', 'm', (0.0, 100.0))
    ] = ()
    wheel_directions: Annotated[
        Numbers, Spec('in which the motor of each omni wheel drives', 'rad', (-7.0, 7.0))
    ] = ()
    slide_angles: Annotated[
        Numbers, Spec('from there to the direction that the rollers leave free', 'rad', (-7.0, 7.0))
    ] = ()
    wheel_radii: Annotated[
        Numbers, Spec('of each omni wheel, or left and right', 'm', (0.001, 10.0))
    ] = ()
    joint_names: Annotated[Texts, Spec('of omni wheels, or left and right')] = ()
    track: Annotated[float, Spec('distance between two wheels', 'm', (0.001, 100.0))] = (
        DifferentialBaseParameters.track
    )

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def model(self) -> RobotModel:
        """Return links and joints of the robot, whose names have no prefix.

        Raises:
            AgvMotionError: The platform is none, or the base has the name of another part.

        """
        base = self.base_frame.removeprefix(self.prefix)
        model: RobotModel = MODELS[Platform(self.platform)](self._base(), base)
        return model

    def _base(self) -> Any:
        kind = BASES[Platform(self.platform)]
        own = [name for name, _, _ in rows(kind) if hasattr(self, name)]
        return kind(**{name: getattr(self, name) for name in own if getattr(self, name) != ()})

    def rim(self) -> float:
        """Return how far the robot reaches from its centre [m]."""
        base = self._base()
        if isinstance(base, PlatformParameters):
            return base.rim
        if isinstance(base, OmniBaseParameters):
            return max(base.wheel_distances) + max(base.wheel_radii)
        return 0.5 * float(base.track) + float(max(base.wheel_radii))

    def radii(self) -> list[float]:
        """Return the radius of each wheel [m], in the order of the model."""
        base = self._base()
        if isinstance(base, PlatformParameters):
            return [base.wheel_radius] * len(base.turret_x)
        return list(base.wheel_radii)
