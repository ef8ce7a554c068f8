"""Routes through waypoints, followed by a virtual point.

A `RouteFollower` makes a twist of each pose; `route_speeds` is its speed as one pure function. What
a drive will look like: :mod:`agv_motion.route.prediction`.
"""

from agv_motion.route.coupling import Coupling, CouplingForm
from agv_motion.route.follower import RouteFollower, RouteLimits, RouteStep
from agv_motion.route.parameters import FollowParameters, Profiles
from agv_motion.route.route import Route
from agv_motion.route.route_file import load_route
from agv_motion.route.speeds import RouteLimiter, RouteSpeeds, route_speeds
from agv_motion.route.table import ProfileTable
from agv_motion.route.virtual_point import VirtualPoint

__all__ = [
    'Coupling',
    'CouplingForm',
    'FollowParameters',
    'ProfileTable',
    'Profiles',
    'Route',
    'RouteFollower',
    'RouteLimiter',
    'RouteLimits',
    'RouteSpeeds',
    'RouteStep',
    'VirtualPoint',
    'load_route',
    'route_speeds',
]
