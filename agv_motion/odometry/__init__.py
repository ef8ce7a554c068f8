"""KNOW: where the robot is, from its wheels, a gyroscope and fixes of its position.

Wheels to a pose: `WheelOdometry`, `OmniOdometry`, `TurretOdometry`. With fixes to a pose in the
map: `PoseFusion`. What the wheels really are, from a drive: :mod:`agv_motion.odometry.calibration`.
"""

from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.fix import Fix, position_fix
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.gyro_odometry import GyroOdometry
from agv_motion.odometry.omni_odometry import OmniOdometry
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.turret_odometry import TurretOdometry
from agv_motion.odometry.wheel_odometry import WheelOdometry

__all__ = [
    'Covariance',
    'Fix',
    'FusionParameters',
    'GyroOdometry',
    'OdometryParameters',
    'OmniOdometry',
    'PoseFusion',
    'TurretOdometry',
    'WheelOdometry',
    'position_fix',
]
