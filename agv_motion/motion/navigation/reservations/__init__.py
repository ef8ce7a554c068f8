"""Several trees in one zone: who may stand and go where, so that they never touch or block.

A `SharedNavigator` takes a tree along, as far as its `RightOfWay` holds the floor. What trees tell
each other: :mod:`.reservation`.
"""

from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator

__all__ = [
    'RightOfWay',
    'SharedNavigator',
    'TrafficParameters',
]
