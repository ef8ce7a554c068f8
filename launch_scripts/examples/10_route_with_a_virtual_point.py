"""A route of waypoints, followed after a virtual point that runs ahead: how far it cuts corners.

A robot that drives straight at a point a distance dp ahead goes round a right angle on a tractrix,
0.48 dp inside of the corner at most: smoother with a larger dp, and farther off.
"""

from agv_motion.planar import Pose
from agv_motion.route import FollowParameters, Route
from agv_motion.route.prediction import predict

route = Route([(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)])
print(f'{len(route.segments)} segments, {route.length:.1f} m')

for distance in (0.25, 0.5, 1.0):
    given = FollowParameters(virtual_point_distance=distance, holonomic=True)
    run = predict(route, given, Pose(0.0, 0.0, 0.0), dt=0.01)
    off = run.cross_track(route)[1]
    slowest = max(run.limiter_shares().items(), key=lambda item: item[1])
    print(f'dp {distance:.2f} m: {run.duration:.1f} s, at most {off:.3f} m off', end='')
    print(f' ({off / distance:.2f} dp); most of the time held by {slowest[0]}')
