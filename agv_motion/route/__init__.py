"""Routes through waypoints, followed by a virtual point.

A `RouteFollower` makes a twist of each pose; `route_speeds` is its speed as one pure function. What
a drive will look like: :mod:`agv_motion.route.prediction`.
"""

from agv_motion.route.follower import RouteFollower
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.route import Route
from agv_motion.route.route_file import load_route
from agv_motion.route.speeds import route_speeds

__all__ = [
    'FollowParameters',
    'Route',
    'RouteFollower',
    'load_route',
    'route_speeds',
]
