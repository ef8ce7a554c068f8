"""An arc as a differential drive is told it: angle and inner diameter; speeds of both wheels.

A quarter to the left, the inner wheel on a circle of 1 m, wheels 0.4 m apart. The outer wheel
speeds up with 0.3 m/s2 to 0.3 m/s and brakes as hard; the inner one keeps the ratio all the time.
"""

from math import degrees, radians

from agv_motion.planar import Pose
from agv_motion.trajectory import Arc, ArcRun

arc = Arc(angle=radians(90), diameter=1.0, track=0.4, speed=0.3, ramp=0.3)
end = arc.end(Pose(0.0, 0.0, 0.0))
print(f'outer wheel {arc.outer_distance:.3f} m, inner {arc.ratio * arc.outer_distance:.3f} m')
print(f'from (0, 0) it leads to ({end.x:.2f}, {end.y:.2f}), {degrees(end.theta):.0f} deg')

run = ArcRun(arc)
print(f'it takes {run.duration:.2f} s')
period = 0.1
cycles = 0
while not run.finished:
    left, right = run.advance(period)  # to hold for the next cycle [m/s]
    cycles += 1
    if cycles in (1, 5, 20, 55):
        print(f'cycle {cycles:2}: left {left:.3f} m/s, right {right:.3f} m/s')
print(f'{cycles} cycles; told in all: left {run.travel.left:.3f} m, right {run.travel.right:.3f} m')
