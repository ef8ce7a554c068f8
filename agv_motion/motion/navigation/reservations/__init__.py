"""Several trees in one zone: who may stand and go where, so that they never touch or block."""

from agv_motion.motion.navigation.reservations.parameters import TrafficParameters
from agv_motion.motion.navigation.reservations.reservation import Reservation
from agv_motion.motion.navigation.reservations.shared_navigator import SharedNavigator

__all__ = [
    'Reservation',
    'SharedNavigator',
    'TrafficParameters',
]
