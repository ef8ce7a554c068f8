"""ACT: maps between the twist of a rigid body and the motion of its wheels.

`Turrets`, `OmniWheels` and `DifferentialDrive` each map one twist to wheels (``command``) and the
wheels to one twist (``twist``); the modules `turret_columns` and `omniwheel_columns` do both for a
whole recording (``command_columns``, ``twist_columns``). What moves in time: `SteeringPlanner` and
`SteeringController` for turrets, `TwistRamp` for wheels that do not steer.
"""

from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.omniwheel_placement import OmniWheel, mecanum_wheels
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.steering.controller import SteeringController
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest, Limiter
from agv_motion.kinematics.turrets import Turrets, centre_of_rotation
from agv_motion.kinematics.twist_ramp import TwistRamp
from agv_motion.kinematics.wheel_limits import WheelLimits

__all__ = [
    'AtRest',
    'DifferentialDrive',
    'Limiter',
    'OmniWheel',
    'OmniWheels',
    'SteeringController',
    'SteeringLimits',
    'SteeringPlanner',
    'Turrets',
    'TwistRamp',
    'WheelLimits',
    'centre_of_rotation',
    'mecanum_wheels',
]
