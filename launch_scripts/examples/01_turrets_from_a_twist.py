"""From a twist to the angle and speed of every turret, and what a speed limit does to them.

The tree has three turrets, 1.18 m from its centre, at -45, 45 and 180 degrees.
"""

from math import degrees, radians

from agv_motion.kinematics import Turrets
from agv_motion.planar import Twist

METRE_A_MINUTE = 1.0 / 60.0

tree = Turrets.from_polar(angles=[radians(-45), radians(45), radians(180)], distances=[1.18] * 3)

for story, twist in (
    ('forward', Twist(METRE_A_MINUTE, 0.0, 0.0)),
    ('to the left', Twist(0.0, METRE_A_MINUTE, 0.0)),
    ('turning on the spot', Twist(0.0, 0.0, METRE_A_MINUTE / 1.18)),
):
    command = tree.command(twist)
    print(f'{story}:')
    for angle, speed in zip(command.angle, command.speed, strict=True):
        print(f'  turret at {degrees(angle):6.1f} deg rolls at {60.0 * speed:.2f} m/min')

# Too fast for the wheels: the whole twist is scaled, so the tree still goes the same way.
fast = tree.command(Twist(0.1, 0.0, 0.0), max_wheel_speed=2.0 * METRE_A_MINUTE)
print(f'6 m/min asked for, 2 allowed: scaled by {fast.scale:.3f}')
