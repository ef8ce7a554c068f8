"""Laws of every odometry: whatever befalls the stamps, it is never surer than right.

The streams are those of a robot that really drives; their messages are swapped, doubled, late, lost
and stamped by a clock that leaps. The error is held against the covariance that is told.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.kinematics.omniwheel_placement import wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.base import DifferentialBase, OmniBase
from agv_motion.odometry.covariance import is_positive_definite, rotate
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.turret_odometry import TurretOdometry
from agv_motion.odometry.wheel_angles import WheelAngles
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.planar import Pose, Twist, compose, integrate, wrap

PERIOD, RADIUS, STEPS = 0.05, 0.1, 120
TRACK = 0.5
OMNI = OmniWheels(wheels_on_circle([pi / 6, 5 * pi / 6, 3 * pi / 2], [0.3] * 3))
TURRETS = Turrets([(0.8, -0.8), (0.8, 0.8), (-1.2, 0.0)])
NOISE = OdometryParameters(wheel_noise=0.01)
WORST = 4.0
"""Standard deviations, of each of x, y and heading."""


class Encoded:
    """Wheels whose encoders count."""

    by_rate = False

    def __init__(self, base, count):
        self.odometry = WheelOdometry(base, [RADIUS] * count, NOISE)

    def take(self, stamp, angles, rates, steering):
        self.odometry.update(stamp, angles)
        return self.odometry.pose, self.odometry.covariance()


class Rated(Encoded):
    """Wheels that tell their rates alone."""

    def __init__(self, base, count):
        super().__init__(base, count)
        self.angles = WheelAngles(count, NOISE.max_gap, NOISE.max_wheel_speed / RADIUS)

    def take(self, stamp, angles, rates, steering):
        self.odometry.update(stamp, self.angles.add(stamp, [], rates), by_rate=True)
        return self.odometry.pose, self.odometry.covariance()


class Turned:
    """Turrets, which tell the speeds of their wheels."""

    def __init__(self):
        self.reckoning = TurretOdometry(TURRETS, NOISE.wheel_noise)

    def take(self, stamp, angles, rates, steering):
        told = self.reckoning.update(stamp, steering, [RADIUS * rate for rate in rates])
        return told.pose, told.covariance


def differential(twist):
    return [twist.vx - 0.5 * TRACK * twist.wz, twist.vx + 0.5 * TRACK * twist.wz], []


def omni(twist):
    return OMNI.command(twist).speed, []


def turrets(twist):
    command = TURRETS.command(twist, [0.0] * 3)
    return command.speed, command.angle


KINDS = {
    'differential, encoders': (lambda: Encoded(DifferentialBase(TRACK), 2), differential),
    'differential, rates': (lambda: Rated(DifferentialBase(TRACK), 2), differential),
    'omni, encoders': (lambda: Encoded(OmniBase(OMNI), 3), omni),
    'omni, rates': (lambda: Rated(OmniBase(OMNI), 3), omni),
    'turrets': (Turned, turrets),
}
FATE = st.sampled_from(['swap', 'double', 'late', 'lose', 'rogue', 'leap'])
EVENTS = st.lists(
    st.tuples(
        st.integers(5, STEPS - 25),
        FATE,
        st.sampled_from([-7200.0, -61.0, -7.0, -1.2, 1.2, 7.0, 61.0, 7200.0, 2.1e9]),
    ),
    max_size=4,
    unique_by=lambda event: event[0] // 20,
)


def drive(wheels, seed=1):
    """Return the pose after each step, and what the wheels tell: (angles, rates, steering)."""
    rng, pose, angles = np.random.default_rng(seed), Pose(0.0, 0.0, 0.0), None
    poses, told = [], []
    twist = Twist(0.4, 0.0, 0.2)
    for i in range(STEPS):
        if i % 20 == 0 and i:
            twist = Twist(float(rng.uniform(0.2, 0.5)), 0.0, float(rng.uniform(-0.4, 0.4)))
        speeds, steering = wheels(twist)
        rates = [speed / RADIUS for speed in speeds]
        angles = [
            angle + rate * PERIOD for angle, rate in zip(angles or [7.0] * len(rates), rates,
                                                         strict=True)
        ]  # fmt: skip
        pose = integrate(pose, twist, PERIOD)
        poses.append(pose)
        told.append((angles, rates, steering))
    return poses, told


def disorder(events):
    """Return the stream of (place in the drive, stamp) that arrives after all these events."""
    clock, stream = 0.0, []
    faults = {place: (fate, leap) for place, fate, leap in events}
    held = []
    for i in range(STEPS):
        fate, leap = faults.get(i, ('', 0.0))
        if fate == 'leap':
            clock += leap
        message = i, 100.0 + PERIOD * i + clock
        if fate == 'late':
            held.append((i + 6, message))
        elif fate == 'rogue':
            stream.append((i, message[1] + leap))
        elif fate == 'double':
            stream += [message, message]
        elif fate == 'swap' and stream:
            stream.insert(len(stream) - 1, message)
        elif fate != 'lose' and not (fate == '' and _within_loss(faults, i)):
            stream.append(message)
        for due, late in list(held):
            if due <= i:
                held.remove((due, late))
                stream.append(late)
    return stream


def _within_loss(faults, i):
    """Return whether the message falls into a silence of 0.4 to 1.2 s that began before."""
    return any(faults.get(i - k, ('', 0))[0] == 'lose' for k in range(1, 9))


def missed(pose, truth, covariance):
    """Return by how many standard deviations x, y and heading are wrong at most."""
    errors = pose.x - truth.x, pose.y - truth.y, wrap(pose.theta - truth.theta)
    spread = covariance.xx, covariance.yy, covariance.tt
    return max(abs(e) / sqrt(max(s, 0.0) + 1e-12) for e, s in zip(errors, spread, strict=True))


@pytest.mark.parametrize('kind', KINDS)
@settings(max_examples=60)
@given(EVENTS)
def test_whatever_befalls_the_stamps_it_is_never_surer_than_right(kind, events):
    make, wheels = KINDS[kind]
    odometry, (poses, told) = make(), drive(wheels)
    first = poses[0]
    for place, stamp in disorder(events):
        pose, covariance = odometry.take(stamp, *told[place])
    assert is_positive_definite(covariance)
    spread = rotate(covariance, first.theta)
    assert missed(compose(first, pose), poses[-1], spread) < WORST


@pytest.mark.parametrize('kind', ['differential, encoders', 'omni, encoders'])
@settings(max_examples=40)
@given(EVENTS)
def test_what_two_positions_tell_is_never_thrown_away(kind, events):
    """Straight on: whatever happens to the stamps, the way is the difference of the encoders."""
    events = [event for event in events if event[0] < STEPS - 40]
    make, wheels = KINDS[kind]
    odometry = make()
    speeds, _ = wheels(Twist(0.4, 0.0, 0.0))
    for place, stamp in disorder(events):
        turned = [speed / RADIUS * PERIOD * place for speed in speeds]
        pose, _ = odometry.take(stamp, turned, [], [])
    assert pose.x == pytest.approx(0.4 * PERIOD * (STEPS - 1), abs=1e-9)
    assert (pose.y, pose.theta) == pytest.approx((0.0, 0.0), abs=1e-9)
