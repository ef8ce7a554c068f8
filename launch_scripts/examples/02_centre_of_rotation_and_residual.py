"""The instantaneous centre of rotation (ICR), and the residual: how much wheels disagree.

Wheels that roll without slipping have all their axes through one point. Measured wheels never do
quite; the best twist leaves a residual, which tells how much the turrets pull against each other.
"""

from math import degrees, radians

from agv_motion.kinematics import Turrets, centre_of_rotation
from agv_motion.planar import Twist

platform = Turrets([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)])
twist = Twist(0.01, 0.0, 0.01)
x, y = centre_of_rotation(twist)
print(f'centre of rotation at ({abs(x):.1f}, {y:.1f}) m: right under the second turret')

command = platform.command(twist, held_angles=[0.0, radians(30.0), 0.0])
print('angles', [round(degrees(angle), 1) for angle in command.angle], 'deg')
print('speeds', [round(speed, 5) for speed in command.speed], 'm/s')
print('the second wheel stands, so its turret keeps its 30 deg')

for story, angles in (
    ('as commanded', command.angle),
    ('the third turret straight ahead', [*command.angle[:2], 0.0]),  # no twist explains that
):
    fit = platform.twist(angles, command.speed)
    print(f'{story}: wz = {fit.twist.wz:.4f} rad/s, residual {fit.residual:.4f} m/s')
