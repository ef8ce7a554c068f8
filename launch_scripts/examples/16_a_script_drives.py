"""A script sends a robot somewhere, tells how far it is, and why it stands if it does.

Start one first, in another terminal: agv up differential
"""

from math import pi

from agv_motion.client import Robot

with Robot() as robot:  # Robot('/hare') for one in a namespace
    robot.go_to(1.0, 0.5)
    while not robot.is_done():  # done, failed, cancelled, stopped or silent: it ends in any case
        told = robot.feedback()
        print(f'{told.state}: {told.distance_left:.2f} m left {told.why}')
        robot.wait(0.5)
    print(f'there: {robot.result().reason}')

    robot.spin(pi / 2)  # radians, to the left
    result = robot.wait(60.0)
    if not result.succeeded:
        robot.cancel()
    print(f'turned: {result.reason}')
