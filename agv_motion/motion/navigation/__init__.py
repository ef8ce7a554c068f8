"""Where the tree may go, and by which path."""

from agv_motion.motion.navigation.path_follower import PathFollower
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone
from agv_motion.motion.navigation.zone_file import load_zone

__all__ = [
    'PathFollower',
    'PathPlanner',
    'Zone',
    'load_zone',
]
