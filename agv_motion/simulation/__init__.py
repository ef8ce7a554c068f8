"""What stands in for the world: sun, tree, vehicle, measurements; all seeded."""

from agv_motion.simulation.differential import DifferentialRobot, DifferentialRobotParameters
from agv_motion.simulation.fixes import FixParameters, FixSensor
from agv_motion.simulation.gyro import Gyro, GyroParameters
from agv_motion.simulation.omni import OmniRobot, OmniRobotParameters
from agv_motion.simulation.shade import Obstacle, irradiance, light_factor, sunlit
from agv_motion.simulation.sun import Sun
from agv_motion.simulation.turret_platform import MotorParameters, TurretPlatform
from agv_motion.simulation.uwb import Uwb, UwbParameters

__all__ = [
    'DifferentialRobot',
    'DifferentialRobotParameters',
    'FixParameters',
    'FixSensor',
    'Gyro',
    'GyroParameters',
    'MotorParameters',
    'Obstacle',
    'OmniRobot',
    'OmniRobotParameters',
    'Sun',
    'TurretPlatform',
    'Uwb',
    'UwbParameters',
    'irradiance',
    'light_factor',
    'sunlit',
]
