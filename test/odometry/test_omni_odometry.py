"""Omni wheels of which some are silent, come back, or cannot be believed."""

from __future__ import annotations

from math import nan, pi

import numpy as np
import pytest

from agv_motion.errors import SignalError
from agv_motion.kinematics.omniwheel_placement import mecanum_wheels, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.omni_odometry import OmniOdometry
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.wheel_monitor import ENOUGH, WheelMonitor
from agv_motion.planar import Pose, Twist, integrate

FOUR = OmniWheels(mecanum_wheels(0.3, 0.2))
FIVE = OmniWheels(wheels_on_circle([i * 2 * pi / 5 for i in range(5)], [0.2] * 5))
GIVEN = OdometryParameters()
RADIUS = 0.05


class Drive:
    """Turns the wheels of a base as random twists ask, for 0.1 s each."""

    def __init__(self, wheels, seed=1):
        self.wheels, self.rng = wheels, np.random.default_rng(seed)
        self.angles, self.stamp, self.pose = np.zeros(len(wheels)), 0.0, Pose(0.0, 0.0, 0.0)

    def step(self):
        twist = Twist(*map(float, self.rng.uniform(-1.0, 1.0, 3)))
        self.angles = self.angles + 0.1 / RADIUS * np.array(self.wheels.command(twist).speed)
        self.stamp, self.pose = self.stamp + 0.1, integrate(self.pose, twist, 0.1)
        return list(map(float, self.angles))


def test_wheels_may_come_and_go_while_the_rest_can_tell():
    drive, odometry = Drive(FIVE), OmniOdometry(FIVE, [RADIUS] * 5, GIVEN)
    odometry.update(0.0, [0.0] * 5)
    for i in range(60):
        angles = drive.step()
        if 10 <= i < 20:
            angles[1] = None
        if 15 <= i < 30:
            angles[4] = None
        if i >= 20:
            angles[1] = angles[1] - 300.0  # its encoder began again meanwhile
        assert odometry.update(drive.stamp, angles) is Succession.MOVED
        assert odometry.left_out == {w for w, angle in enumerate(angles) if angle is None}
    assert odometry.reckoning.pose == pytest.approx(drive.pose, abs=1e-9)


def test_one_wheel_less_is_less_sure():
    certainty = []
    for silent in (None, 2):
        drive, odometry = Drive(FOUR), OmniOdometry(FOUR, [RADIUS] * 4, GIVEN)
        odometry.update(0.0, [0.0] * 4)
        for _ in range(20):
            angles = [None if w == silent else a for w, a in enumerate(drive.step())]
            odometry.update(drive.stamp, angles)
        certainty.append(odometry.reckoning.covariance().tt)
    assert certainty[1] > 1.2 * certainty[0]


def test_what_it_cannot_use_changes_nothing():
    odometry = OmniOdometry(FOUR, [RADIUS] * 4, GIVEN)
    with pytest.raises(SignalError, match=r'wheels \[1\] are missing in the first reading'):
        odometry.update(0.0, [0.0, None, 0.0, 0.0])
    odometry.update(0.0, [0.0] * 4)
    with pytest.raises(SignalError, match=r'only wheels \(0, 1\) of 4 measure'):
        odometry.update(0.1, [1.0, 1.0, None, None])
    with pytest.raises(SignalError, match='wheel angles must be finite'):
        odometry.update(0.1, [1.0, nan, 1.0, 1.0])
    assert odometry.update(0.0, [9.0] * 4) is Succession.DUPLICATE
    assert odometry.update(-0.1, [9.0, None, 9.0, 9.0]) is Succession.LATE
    assert not odometry.left_out
    assert odometry.update(0.1, [1.0] * 4) is Succession.MOVED
    assert odometry.reckoning.pose.x == pytest.approx(RADIUS)


@pytest.mark.parametrize('wheels', [FOUR, FIVE], ids=['four', 'five'])
@pytest.mark.parametrize('gain', [0.0, 0.7])
def test_a_wheel_that_measures_too_little_is_found_and_only_then(wheels, gain):
    n = len(wheels)
    drive, monitor = Drive(wheels), WheelMonitor(wheels, [RADIUS] * n, GIVEN)
    for i in range(300):
        angles = drive.step()
        monitor.add(drive.stamp, angles)
        if i == 5 * ENOUGH:
            assert monitor.diagnosis().consistent
    wrong, gains = np.array(angles), np.where(np.arange(n) == 1, gain, 1.0)
    for _ in range(300):
        before = drive.angles
        wrong = wrong + gains * (np.array(drive.step()) - before)
        monitor.add(drive.stamp, list(map(float, wrong)))
    assert monitor.diagnosis().faulty == 1


def test_wheels_one_per_cent_off_are_sound():
    drive, monitor = Drive(FOUR), WheelMonitor(FOUR, [0.0505, 0.0495, 0.05, 0.05], GIVEN)
    for _ in range(400):
        monitor.add(drive.stamp, drive.step())
    assert monitor.diagnosis().consistent
