"""What stands in for the world: sun, tree, vehicle, measurements; all seeded.

The parameters of each stand beside it in its module; light over a zone: :mod:`.shade`, by
:mod:`agv_motion.sun`.
"""

from agv_motion.simulation.differential import DifferentialRobot
from agv_motion.simulation.fixes import FixSensor
from agv_motion.simulation.gyro import Gyro
from agv_motion.simulation.omni import OmniRobot
from agv_motion.simulation.turret_platform import TurretPlatform

__all__ = [
    'DifferentialRobot',
    'FixSensor',
    'Gyro',
    'OmniRobot',
    'TurretPlatform',
]
