"""Trajectories in time: speed profiles, curves, the Ghost, and laws that follow it.

A `Ghost` computes a `Trajectory` and runs along it in exact time; a `Follower` keeps a robot behind
it, one twist a cycle. `trapezoid`, `Arc` and `ArcRun` serve controllers that know no pose.
"""

from agv_motion.trajectory.arc import Arc
from agv_motion.trajectory.arc_run import ArcRun
from agv_motion.trajectory.bounds import NO_RAMP
from agv_motion.trajectory.follower import Follower
from agv_motion.trajectory.follower_parameters import FollowerParameters
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.holonomic import Holonomic
from agv_motion.trajectory.kanayama import Kanayama
from agv_motion.trajectory.ramsete import Ramsete
from agv_motion.trajectory.tracking import tracking_error
from agv_motion.trajectory.trapezoidal import trapezoid

__all__ = [
    'NO_RAMP',
    'Arc',
    'ArcRun',
    'Follower',
    'FollowerParameters',
    'Ghost',
    'GhostParameters',
    'Holonomic',
    'Kanayama',
    'Ramsete',
    'tracking_error',
    'trapezoid',
]
