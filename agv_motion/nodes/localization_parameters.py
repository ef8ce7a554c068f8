"""What the node `localization` has to be told."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated

from agv_motion.model.frames import FrameParameters
from agv_motion.odometry.assumed_noise import AssumedNoiseParameters
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.yaw_rate import YawRateParameters
from agv_motion.parameters import Spec, check


class NoiseSource(Enum):
    """Whence the noise of odometry."""

    ASSUMED = 'assumed'
    """From the way, by `odom_noise`"""
    MESSAGE = 'message'
    """The covariance in each message"""


class ToldTransforms(Enum):
    """Which transforms are published."""

    BOTH = 'both'
    """From map to odom, and from odom to the robot"""
    MAP = 'map'
    """From map to odom"""
    NONE = 'none'


@dataclass(frozen=True)
class LocalizationParameters(FrameParameters):
    """Frames, how far odometry is trusted, and when the pose is no longer told."""

    odom_covariance: Annotated[
        str,
        Spec(
            'whence the noise of odometry: assumed from the way (odom_noise), or the one in the '
            'message, which must grow with the way as that of omni_kinematics does',
            choices=tuple(each.value for each in NoiseSource),
        ),
    ] = NoiseSource.ASSUMED.value
    max_position_deviation: Annotated[
        float, Spec('standard deviation beyond which the pose is not told', 'm', (0.01, 100.0))
    ] = 1.0
    max_heading_deviation: Annotated[
        float, Spec('standard deviation beyond which the pose is not told', 'rad', (0.01, 3.2))
    ] = 0.5
    rate: Annotated[
        float,
        Spec('pose and /tf, highest rate; 0: with each odometry message', 'Hz', (0.0, 1000.0)),
    ] = 0.0
    odom_timeout: Annotated[
        float, Spec('silence of odom after which it is lost', 's', (0.01, 3600.0))
    ] = 1.0
    max_age: Annotated[
        float, Spec('how far stamps of odom, fix and imu may lie from now', 's', (0.01, 1e10))
    ] = 2.0
    tf: Annotated[
        str,
        Spec('transforms to publish where tf2_msgs is installed: map to odom, odom to base_link',
             choices=tuple(each.value for each in ToldTransforms)),
    ] = ToldTransforms.BOTH.value  # fmt: skip
    map_frame: Annotated[str, Spec('frame of fixes and pose')] = 'map'
    odom_frame: Annotated[str, Spec('frame of the odometry')] = 'odom'
    imu_frame: Annotated[str, Spec('frame of the gyroscope, its z axis upright')] = 'imu_link'
    odom_noise: AssumedNoiseParameters = field(default_factory=AssumedNoiseParameters)
    gyro: YawRateParameters = field(default_factory=YawRateParameters)
    fusion: FusionParameters = field(default_factory=FusionParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)
