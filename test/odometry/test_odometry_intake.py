"""Odometry of another: which message counts, by hand, and with what noise."""

from __future__ import annotations

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.odometry.assumed_noise import AssumedNoise
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import CERTAIN, Covariance
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.gates import MAX_DEVIATION, MAX_WAY
from agv_motion.odometry.history import Waypoint
from agv_motion.odometry.odometry_intake import OdometryIntake
from agv_motion.odometry.yaw_rate import YawRate
from agv_motion.planar import Pose

ORIGIN = Pose(0.0, 0.0, 0.0)
DOUBTED, MOVED = Succession.DOUBTED, Succession.MOVED


def intake(noise=None):
    """Return an intake of a robot that makes 1 m/s and turns by 2 rad/s at most."""
    return OdometryIntake(FusionParameters(max_speed=1.0, max_turn_rate=2.0), noise)


def second(pose, noise=CERTAIN, first=ORIGIN, first_noise=CERTAIN, dt=0.1):
    """Return what becomes of a message ``dt`` after the first."""
    own = intake()
    assert own.take(5.0, first, first_noise) == (
        Succession.FIRST, Waypoint(5.0, first, first_noise), None, 0.0,
    )  # fmt: skip
    return own.take(5.0 + dt, pose, noise).step


@pytest.mark.parametrize('angle', [0.0, 0.5 * pi, pi, -2.0])
@pytest.mark.parametrize(('way', 'step'), [(0.1099, MOVED), (0.1101, DOUBTED)])
def test_no_robot_goes_farther_than_its_speed_lets_it_and_a_centimetre(angle, way, step):
    there = Pose(3.0 + way * cos(angle), -4.0 + way * sin(angle), 0.0)
    assert second(there, first=Pose(3.0, -4.0, 0.0)) is step


@pytest.mark.parametrize(('turn', 'step'), [(0.249, MOVED), (0.251, DOUBTED)])
@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_none_turns_faster_than_it_can_also_past_the_half_turn(turn, step, sign):
    """Hand calculation: 2 rad/s for 0.1 s and 0.05 rad."""
    assert second(Pose(0.0, 0.0, sign * turn)) is step
    assert second(Pose(0.0, 0.0, sign * (turn - pi)), first=Pose(0.0, 0.0, sign * pi)) is step


@pytest.mark.parametrize(
    ('added', 'step'),
    [
        (Covariance(1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4), MOVED),
        (Covariance(-1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4), DOUBTED),
        (Covariance(1e-4, 0.0, 0.0, -1e-4, 0.0, 1e-4), DOUBTED),
        (Covariance(1e-4, 0.0, 0.0, 1e-4, 0.0, -1e-4), DOUBTED),
        (Covariance(1e-4, 0.99e-4, 0.0, 1e-4, 0.0, 1e-4), MOVED),
        (Covariance(1e-4, 1.01e-4, 0.0, 1e-4, 0.0, 1e-4), DOUBTED),
        (Covariance(1e-4, 0.0, -0.99e-4, 1e-4, 0.0, 1e-4), MOVED),
        (Covariance(1e-4, 0.0, -1.01e-4, 1e-4, 0.0, 1e-4), DOUBTED),
        (Covariance(1e-4, 0.0, 0.0, 1e-4, 0.99e-4, 1e-4), MOVED),
        (Covariance(1e-4, 0.0, 0.0, 1e-4, 1.01e-4, 1e-4), DOUBTED),
        (Covariance(0.99 * MAX_DEVIATION**2, 0.0, 0.0, 0.0, 0.0, 0.0), MOVED),
        (Covariance(1.01 * MAX_DEVIATION**2, 0.0, 0.0, 0.0, 0.0, 0.0), DOUBTED),
    ],
)
def test_between_two_messages_noise_is_only_added(added, step):
    """At the origin the noise about it is that about the robot: the numbers are as they read."""
    before = Covariance(1e-3, 0.0, 0.0, 2e-3, 0.0, 3e-3)
    sums = Covariance(*(a + b for a, b in zip(before, added, strict=True)))
    assert second(ORIGIN, sums, first_noise=before) is step


@given(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0))
def test_noise_is_added_where_the_robot_is(x, y):
    """A turn that is unsure by sigma about (x, y) moves the origin by (y, -x) sigma."""
    sigma = 1e-3
    before = Covariance(10.0, 0.0, 0.0, 10.0, 0.0, sigma)
    added = Covariance(y * y * sigma, -x * y * sigma, y * sigma, x * x * sigma, -x * sigma, sigma)
    here = Pose(x, y, 0.0)

    def step(noise):
        sums = Covariance(*(a + b for a, b in zip(before, noise, strict=True)))
        return second(here, sums, first=here, first_noise=before)

    assert step(added) is MOVED
    if abs(x) > 1.0:
        assert step(added._replace(yy=0.5 * added.yy)) is DOUBTED
    if abs(y) > 1.0:
        assert step(added._replace(xx=0.5 * added.xx)) is DOUBTED


def test_after_a_leap_it_is_told_where_all_began_anew_and_how_long_nothing_was_seen():
    own = intake()
    own.take(0.0, ORIGIN, CERTAIN)
    assert own.take(900.0, Pose(0.5, 0.0, 0.0), CERTAIN).step is DOUBTED
    begun, now = Waypoint(900.0, Pose(0.5, 0.0, 0.0), CERTAIN), Pose(0.55, 0.0, 0.0)
    assert own.take(900.1, now, CERTAIN) == (
        Succession.LEAP, Waypoint(900.1, now, CERTAIN), begun, 900.0,
    )  # fmt: skip
    assert own.take(900.2, now, CERTAIN) == (MOVED, Waypoint(900.2, now, CERTAIN), None, 0.0)


def test_assumed_noise_does_not_grow_by_a_jump():
    """Hand calculation: 1 m makes (2 cm)^2 in both directions, and a jump of 40 m nothing."""
    own = intake(AssumedNoise())
    own.take(0.0, ORIGIN, CERTAIN)
    first = own.take(1.0, Pose(1.0, 0.0, 0.0), CERTAIN).waypoint.noise
    assert (first.xx, first.tt) == pytest.approx((4e-4, 4e-4))
    assert own.take(1.1, Pose(41.0, 0.0, 0.0), CERTAIN).step is DOUBTED
    passage = own.take(2.1, Pose(42.0, 0.0, 0.0), CERTAIN)
    assert passage.step is Succession.RESET
    assert passage.begun is not None
    assert passage.begun[:2] == (1.1, Pose(41.0, 0.0, 0.0))
    assert passage.begun.noise == pytest.approx(first, abs=1e-12)
    assert (passage.waypoint.noise.xx, passage.waypoint.noise.tt) == pytest.approx((8e-4, 8e-4))


def test_a_gyroscope_mends_the_turn_and_not_the_way():
    """The wheels saw a turn by 0.2 rad, the gyroscope one by 0.1 rad; way and stamp are as told."""
    own, gyro = intake(), YawRate()
    own.take(0.0, ORIGIN, CERTAIN, gyro)
    for i in range(11):
        gyro.add(0.1 * i, 0.1)
    unsure = Covariance(1e-6, 0.0, 0.0, 1e-6, 0.0, 1.0)
    passage = own.take(1.0, Pose(0.0, 0.0, 0.2), unsure, gyro)
    assert passage.step is MOVED
    assert passage.waypoint.stamp == 1.0
    assert passage.waypoint.pose == pytest.approx((0.0, 0.0, 0.1), abs=1e-3)
    assert passage.waypoint.noise.tt < 0.01


@pytest.mark.parametrize('sign', [1.0, -1.0])
@pytest.mark.parametrize('axis', ['x', 'y'])
def test_beyond_the_farthest_way_it_is_refused(axis, sign):
    own = intake()
    far = ORIGIN._replace(**{axis: sign * MAX_WAY})
    own.take(0.0, far, CERTAIN)
    with pytest.raises(SignalError, match=r'odometry \(x, y\).*begin anew at 0'):
        own.take(0.1, far._replace(**{axis: sign * (MAX_WAY + 0.01)}), CERTAIN)
