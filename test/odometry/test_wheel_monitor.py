"""Four wheels over some seconds: who disagrees is found, who stands or is missing tells nothing."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from agv_motion.kinematics.omniwheel_placement import wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.wheel_monitor import ENOUGH, SOUND, SPAN, TOLERANCE, WheelMonitor
from agv_motion.planar import Twist

WHEELS = OmniWheels(wheels_on_circle([2 * pi * i / 4 for i in range(4)], [0.2] * 4))
RADII = [0.05] * 4
TWISTS = [Twist(0.3, 0.1, 0.4), Twist(-0.2, 0.3, -0.5), Twist(0.1, -0.4, 0.8)]


class Drive:
    """Changes its mind at every instant; one wheel may measure a share of what it turns."""

    def __init__(self, shares=(1.0,) * 4, wheels=WHEELS):
        self.monitor = WheelMonitor(wheels, RADII, OdometryParameters())
        self.shares, self.time, self.angles = shares, 0.0, [0.0] * 4
        self.monitor.add(0.0, self.angles)

    def go(self, instants, period=SPAN):
        for k in range(instants):
            speeds = WHEELS.command(TWISTS[k % 3]).speed
            self.angles = [
                angle + share * speed * period / radius
                for angle, share, speed, radius in zip(
                    self.angles, self.shares, speeds, RADII, strict=True
                )
            ]
            self.time += period
            self.monitor.add(self.time, self.angles)
        return self.monitor.diagnosis()


def test_sound_wheels_are_sound():
    assert Drive().go(30).consistent


@pytest.mark.parametrize('wheel', range(4))
def test_a_wheel_that_measures_half_is_found(wheel):
    shares = [0.5 if i == wheel else 1.0 for i in range(4)]
    found = Drive(shares).go(30)
    assert not found.consistent
    assert found.suspects == (wheel,)


def test_nothing_is_said_before_enough_was_seen():
    drive = Drive((0.5, 1.0, 1.0, 1.0))
    assert drive.go(ENOUGH - 1) == SOUND
    assert not drive.go(1).consistent


def test_a_wheel_that_is_back_is_forgiven_after_a_while():
    drive = Drive((0.5, 1.0, 1.0, 1.0))
    assert not drive.go(20).consistent
    drive.shares = (1.0,) * 4
    assert drive.go(45).consistent


def test_gaps_standstill_and_readings_that_cannot_be_tell_nothing():
    drive = Drive((0.5, 1.0, 1.0, 1.0))
    for _ in range(30):  # each second reading lacks a wheel
        drive.go(1)
        drive.monitor.add(drive.time, [None, *drive.angles[1:]])
    assert drive.monitor.diagnosis() == SOUND
    assert drive.go(30, period=2.5 * SPAN) == SOUND
    for k in range(30):
        drive.monitor.add(drive.time + SPAN * (k + 1), drive.angles)
    assert drive.monitor.diagnosis() == SOUND
    for k in range(30):
        drive.monitor.add(1e4 + SPAN * k, [1e6 * k, 0.0, 0.0, 0.0])
    assert drive.monitor.diagnosis() == SOUND


def test_three_wheels_can_blame_nobody():
    three = OmniWheels(wheels_on_circle([2 * pi * i / 3 for i in range(3)], [0.2] * 3))
    monitor = WheelMonitor(three, [0.05] * 3, OdometryParameters())
    for k in range(30):
        monitor.add(SPAN * k, [5.0 * k, 0.0, 0.0])
    assert monitor.diagnosis() == SOUND


def test_travels_are_told_in_deviations_by_hand():
    """1 m each: slip of 0.03 m, a hundredth for the radius, and two roundings of 0.01 rad."""
    given = OdometryParameters(wheel_noise=0.03, encoder_resolution=0.01, max_wheel_speed=10.0)
    monitor = WheelMonitor(WHEELS, RADII, given)
    monitor.add(0.0, [0.0] * 4)
    monitor.add(SPAN, [1.0 / 0.05] * 4)
    noise = sqrt(0.03**2 + TOLERANCE**2 + 0.0005**2 / 6.0)
    (column,) = monitor._columns  # noqa: SLF001 - what is told of
    assert column == pytest.approx([1.0 / noise] * 4, rel=1e-9)
