"""Of all who ask a robot to move, one is obeyed.

An `Arbiter` takes what each `TwistSource` says and makes a `Choice`: who drives and how all others
stand; `sentence` says it in plain English. Limits of the whole robot come after it:
:mod:`.chassis_limits`.
"""

from agv_motion.arbitration.arbiter import Arbiter
from agv_motion.arbitration.sentence import sentence
from agv_motion.arbitration.source import TwistSource

__all__ = [
    'Arbiter',
    'TwistSource',
    'sentence',
]
