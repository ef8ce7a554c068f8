"""The command of the tree, its limits, and the twist it means."""

from agv_motion.motion.command.floor_rules import FloorRules
from agv_motion.motion.command.limits import CommandLimit, CommandLimits, LimitParameters
from agv_motion.motion.command.polar import PolarCommand, polar_command, to_polar, to_twist
from agv_motion.motion.command.ramp import Ramp

__all__ = [
    'CommandLimit',
    'CommandLimits',
    'FloorRules',
    'LimitParameters',
    'PolarCommand',
    'Ramp',
    'polar_command',
    'to_polar',
    'to_twist',
]
