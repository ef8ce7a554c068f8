"""The Ghost, the ideal robot, runs along a curve; a law of control keeps a real one behind it.

The robot stands 10 cm to the side of where it should, and its wheels slip by 3 %. Both are made
good by the law of Kanayama: the function V of the error never grows but by the slip.
"""

from math import degrees, hypot, pi

from agv_motion.planar import Pose, Twist, integrate
from agv_motion.trajectory import Ghost, Kanayama, tracking_error
from agv_motion.trajectory.motion import Speeds

ghost, law = Ghost(Pose(0.0, 0.0, 0.0)), Kanayama()
trajectory = ghost.compute_trajectory(
    Pose(2.0, 1.0, pi / 2), delta_curve=0.5, speed_ramps=0.3, cruising_speed=0.4
)
print(f'{trajectory.duration:.2f} s ahead; in words: {", ".join(ghost.report().lines())}')

robot, period, cycle = Pose(0.0, 0.10, 0.0), 0.02, 0
ghost.lock(False)  # noqa: FBT003 - now its time passes
while not ghost.finished:
    ghost.advance(period)
    place, linear, angular = ghost.controller_kinetics()
    error = tracking_error(place, robot)
    twist = law.twist(error, Speeds(linear, angular))
    robot = integrate(robot, Twist(0.97 * twist.vx, 0.0, 0.97 * twist.wz), period)
    cycle += 1
    if cycle % 100 == 0 or ghost.finished:
        off, v = 100 * hypot(error.along, error.across), 1e4 * law.lyapunov(error)
        print(f'{cycle * period:5.2f} s  {off:5.2f} cm off, V = {v:.2f} cm2')
print(f'the Ghost rests at ({place.x:.2f}, {place.y:.2f}), {degrees(place.theta):.0f} deg')
