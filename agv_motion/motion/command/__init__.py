"""The command of the tree, its limits, and the twist it means."""

from agv_motion.motion.command.limits import FloorRules, Limit, LimitParameters, Limits
from agv_motion.motion.command.polar import PolarCommand, polar_command, to_polar, to_twist
from agv_motion.motion.command.ramp import Ramp

__all__ = [
    'FloorRules',
    'Limit',
    'LimitParameters',
    'Limits',
    'PolarCommand',
    'Ramp',
    'polar_command',
    'to_polar',
    'to_twist',
]
