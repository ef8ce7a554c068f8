"""Steering of a platform on turrets: one centre of rotation at all times, and every limit held."""

from agv_motion.kinematics.steering.alignment import rolling_share
from agv_motion.kinematics.steering.controller import SteeringController
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest, Limiter, Rolling, Setpoints

__all__ = [
    'AtRest',
    'Limiter',
    'Rolling',
    'Setpoints',
    'SteeringController',
    'SteeringLimits',
    'SteeringPlanner',
    'rolling_share',
]
