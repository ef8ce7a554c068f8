"""Of all who ask a robot to move, one is obeyed.

An `Arbiter` takes what each `TwistSource` says and chooses; `ChassisLimits` come after it. A
`Choice` tells who drives and how all others stand; `sentence` says it in plain English.
"""

from agv_motion.arbitration.arbiter import Arbiter
from agv_motion.arbitration.chassis_limits import ChassisLimitParameters, ChassisLimits
from agv_motion.arbitration.sentence import sentence
from agv_motion.arbitration.source import TwistSource

__all__ = [
    'Arbiter',
    'ChassisLimitParameters',
    'ChassisLimits',
    'TwistSource',
    'sentence',
]
