"""The command of the tree, its limits, and the twist it means."""

from agv_motion.motion.command.limits import CommandLimits, LimitParameters
from agv_motion.motion.command.polar import PolarCommand, to_polar, to_twist

__all__ = [
    'CommandLimits',
    'LimitParameters',
    'PolarCommand',
    'to_polar',
    'to_twist',
]
