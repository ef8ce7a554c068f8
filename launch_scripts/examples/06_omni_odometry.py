"""Odometry of an omni robot: angles of its wheels in, pose out, exact on arcs.

Four wheels, 0.2 m from the centre. It goes a quarter of a circle of 1 m radius, loses the encoder
of a wheel, and goes on by the other three. Two would not tell the motion, and it says so.
"""

from math import degrees, pi, radians

from agv_motion.errors import SignalError
from agv_motion.kinematics import OmniWheels
from agv_motion.odometry import OdometryParameters, OmniOdometry
from agv_motion.planar import Twist

RADII = [0.05] * 4
wheels = OmniWheels.from_polar([radians(a) for a in (45, 135, 225, 315)], [0.2] * 4, RADII)
odometry = OmniOdometry(wheels, RADII, OdometryParameters())
angles, time = [0.0] * 4, 0.0
odometry.update(time, angles)


def drive(twist: Twist, duration: float, *, broken: tuple[int, ...] = ()) -> None:
    """Let the wheels turn for ``duration`` [s], read ten times a second."""
    global angles, time  # noqa: PLW0603 - a world of two numbers
    rates = wheels.rates(wheels.command(twist).speed)
    for _ in range(10):
        time += duration / 10
        angles = [a + rate * duration / 10 for a, rate in zip(angles, rates, strict=True)]
        odometry.update(time, [None if i in broken else a for i, a in enumerate(angles)])
    x, y, theta = odometry.reckoning.pose
    print(f'x {x:.3f} m, y {y:.3f} m, heading {degrees(theta):.1f} deg; left out: {[*broken]}')


drive(Twist(0.1, 0.0, 0.1), pi / 2 / 0.1)
drive(Twist(0.1, 0.0, 0.0), 5.0, broken=(3,))
try:
    drive(Twist(0.1, 0.0, 0.0), 5.0, broken=(2, 3))
except SignalError as error:
    print(error)
