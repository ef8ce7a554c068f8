"""ACT: maps between the twist of a rigid body and the motion of its wheels."""

from agv_motion.kinematics.differential import DifferentialDrive, WheelSpeeds
from agv_motion.kinematics.omniwheel_placement import OmniWheel, mecanum_wheels, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.kinematics.steering import (
    AtRest,
    Limiter,
    Rolling,
    SteeringController,
    SteeringLimits,
    SteeringPlanner,
    alignment,
)
from agv_motion.kinematics.turrets import Turrets, centre_of_rotation
from agv_motion.kinematics.twist_ramp import TwistRamp
from agv_motion.kinematics.wheel_limits import WheelLimits

__all__ = [
    'AtRest',
    'DifferentialDrive',
    'Limiter',
    'OmniWheel',
    'OmniWheels',
    'PlatformParameters',
    'Rolling',
    'SteeringController',
    'SteeringLimits',
    'SteeringPlanner',
    'Turrets',
    'TwistRamp',
    'WheelLimits',
    'WheelSpeeds',
    'alignment',
    'centre_of_rotation',
    'mecanum_wheels',
    'wheels_on_circle',
]
