"""Where the tree may go, and by which path."""

from agv_motion.motion.navigation.navigator import Guidance, Navigator, StraightNavigator
from agv_motion.motion.navigation.path_follower import PathFollower
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.motion.navigation.zone_text import text_of_zone, zone_of_text

__all__ = [
    'Guidance',
    'Navigator',
    'PathFollower',
    'PathPlanner',
    'StraightNavigator',
    'Zone',
    'load_zone',
    'text_of_zone',
    'zone_of_text',
]
