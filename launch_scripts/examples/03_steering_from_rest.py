"""A tree steers from rest: first its turrets turn, then it rolls, about one centre at all times.

Turrets turn a quarter turn in six seconds, no faster. The planner is asked twenty times a second.
"""

from math import degrees, radians

from agv_motion.kinematics import AtRest, Limiter, SteeringLimits, SteeringPlanner, Turrets
from agv_motion.planar import Twist

tree = Turrets.from_polar(angles=[radians(-45), radians(45), radians(180)], distances=[1.18] * 3)
planner = SteeringPlanner(tree, SteeringLimits())
phase = AtRest.at([0.0, 0.0, 0.0])
wanted = Twist(0.0, 1.0 / 60.0, 0.0)  # to the left: every turret has to turn a quarter turn
period = 0.05

said = None
for step in range(400):
    phase = planner.step(phase, wanted, period)
    setpoints = phase.setpoints
    if setpoints.limiter is not said:
        said = setpoints.limiter
        print(f'{step * period:5.2f} s  {type(phase).__name__:8} {said.value or "as wanted"}')
    if said is Limiter.NONE:
        break

print('angles', [round(degrees(angle), 1) for angle in setpoints.angles], 'deg')
print('speeds', [round(60.0 * speed, 3) for speed in setpoints.speeds], 'm/min')
print(f'it moves to the left at {60.0 * setpoints.twist(tree).vy:.3f} m/min')
