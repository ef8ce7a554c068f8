"""Odometry of every base: where it is, how sure it is, and what it does about bad readings."""

from __future__ import annotations

from math import nan, pi, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.omniwheel_placement import mecanum_wheels, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.base import DifferentialBase, OmniBase, TurretBase
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.odometry.yaw_rate import GyroTurn
from agv_motion.planar import Pose, Twist, integrate

THREE = OmniWheels(wheels_on_circle([pi / 6, 5 * pi / 6, 3 * pi / 2], [0.2] * 3))
FOUR = OmniWheels(mecanum_wheels(0.3, 0.2))
SPEED = st.floats(-1.0, 1.0)
TWISTS = st.lists(st.builds(Twist, SPEED, SPEED, SPEED), min_size=1, max_size=20)


def drive(odometry, wheels, twists, radius=0.05, period=0.1):
    """Roll the wheels as ``twists`` ask, each for one period; return the stamp at the end."""
    angles = [0.0] * len(wheels)
    odometry.update(0.0, angles)
    for i, twist in enumerate(twists):
        speeds = wheels.command(twist).speed
        angles = [a + v * period / radius for a, v in zip(angles, speeds, strict=True)]
        assert odometry.update(period * (i + 1), angles) is Succession.MOVED
    return period * len(twists), angles


def test_before_the_first_reading_it_stands_at_the_origin():
    odometry = WheelOdometry(OmniBase(THREE), [0.05] * 3)
    assert (odometry.stamp, odometry.pose) == (None, Pose(0.0, 0.0, 0.0))
    assert odometry.twist == Twist(0.0, 0.0, 0.0)
    assert odometry.residual == 0.0
    assert set(odometry.covariance() + odometry.twist_covariance()) == {0.0}


@given(TWISTS)
def test_the_pose_is_the_integral_of_the_twists(twists):
    odometry = WheelOdometry(OmniBase(THREE), [0.05] * 3)
    drive(odometry, THREE, twists)
    expected = Pose(0.0, 0.0, 0.0)
    for twist in twists:
        expected = integrate(expected, twist, 0.1)
    assert odometry.pose[:2] == pytest.approx(expected[:2], abs=1e-11)
    assert (odometry.pose.theta - expected.theta + 1) % (2 * pi) == pytest.approx(1, abs=1e-11)
    assert odometry.twist == pytest.approx(twists[-1], abs=1e-9)


def test_wheels_of_different_radii():
    odometry = WheelOdometry(DifferentialBase(0.4), [0.1, 0.05])
    odometry.update(0.0, [0.0, 0.0])
    odometry.update(0.1, [1.0, 2.0])
    assert odometry.pose == pytest.approx((0.1, 0.0, 0.0), abs=1e-15)


def test_turrets_that_steer_on_the_way_count_with_their_angle_halfway():
    """Hand calculation: while turning from 3.1 to -3.1 rad a turret points at pi, backwards."""
    odometry = WheelOdometry(TurretBase(Turrets([(1.0, 0.0), (-1.0, 0.0)])), [0.1, 0.1])
    odometry.update(0.0, [0.0, 0.0], steering=[3.1, 3.1])
    odometry.update(0.1, [1.0, 1.0], steering=[-3.1, -3.1])
    assert odometry.pose == pytest.approx((-0.1, 0.0, 0.0), abs=1e-12)


def test_variance_grows_with_the_distance():
    """Hand calculation: of two wheels of 1 cm after 1 m, the mean after 4 m has 2 cm / sqrt 2."""
    given_noise = OdometryParameters(wheel_noise=0.01)
    odometry = WheelOdometry(DifferentialBase(0.4), [0.1, 0.1], given_noise)
    for i in range(41):
        odometry.update(0.1 * i, [1.0 * i, 1.0 * i])
    assert sqrt(odometry.covariance().xx) == pytest.approx(0.02 / sqrt(2), rel=1e-12)
    assert sqrt(odometry.covariance().tt) == pytest.approx(0.02 * sqrt(2) / 0.4, rel=1e-12)


def test_slip_that_the_wheels_measure_widens_the_covariance():
    quiet, slipping = (WheelOdometry(OmniBase(FOUR), [0.1] * 4) for _ in range(2))
    for i in range(11):
        quiet.update(0.1 * i, [0.1 * i] * 4)
        slipping.update(0.1 * i, [0.14 * i, 0.1 * i, 0.1 * i, 0.1 * i])
    assert slipping.residual == pytest.approx(0.1 * 0.04 / 0.1 / 4, rel=1e-9)
    assert quiet.residual < 1e-12
    # hand calculation: the residual of each step is 0.04 * 0.1 / 4 m in all four, the variance of
    # one travel thus 4 (0.001 m)^2, a quarter of which is the variance of x; ten such steps
    assert slipping.covariance().xx == pytest.approx(10 * 1e-6, rel=0.2)
    assert slipping.covariance().xx > 10 * quiet.covariance().xx / 3


def test_the_rounding_of_encoders_is_no_slip():
    coarse = OdometryParameters(encoder_resolution=0.01)
    odometry = WheelOdometry(OmniBase(FOUR), [0.1] * 4, coarse)
    for i in range(100):
        odometry.update(0.02 * i, [0.01 * round(k + 0.3 * i) for k in (0.1, 0.6, 0.3, 0.9)])
    usual = 100 * 0.005**2 * 0.003 * 0.1 / 4
    assert odometry.covariance().xx < 1.5 * usual


def test_a_gap_is_bridged_with_doubt():
    odometry = WheelOdometry(DifferentialBase(0.4), [0.1, 0.1], OdometryParameters(gap_noise=0.5))
    odometry.update(0.0, [0.0, 0.0])
    assert odometry.update(5.0, [10.0, 10.0]) is Succession.GAP
    assert odometry.pose == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    assert odometry.covariance().xx == pytest.approx(0.5**2 / 2, rel=0.01)


@pytest.mark.parametrize('leap', [-40.0, 40.0])
def test_what_was_rolled_while_the_clock_leapt_is_travel_but_no_speed(leap):
    """3 m in a time that nobody knows, at 0.2 m/s before and after."""
    odometry = WheelOdometry(DifferentialBase(0.3), [0.05, 0.05])
    rolled = [0.0, 0.02, 0.04, 3.04, 3.06, 3.08]
    stamps = [0.0, 0.1, 0.2, 0.2 + leap, 0.3 + leap, 0.4 + leap]
    twists, steps = [], []
    for stamp, way in zip(stamps, rolled, strict=True):
        steps.append(odometry.update(stamp + 100.0, [way / 0.05, way / 0.05]))
        twists.append(odometry.twist.vx)
    assert steps[3:] == [Succession.DOUBTED, Succession.LEAP, Succession.MOVED]
    assert twists[1:] == pytest.approx([0.2] * 5)
    assert odometry.pose.x == pytest.approx(3.08)
    assert sqrt(odometry.covariance().xx) >= 3.0


def test_a_reset_leaves_the_pose_and_doubts_it_by_the_way_it_may_have_gone():
    """Hand calculation: at 1 m/s before, 0.2 s without knowledge are 0.2 m, of both wheels alike.

    The step of 0.1 s after the encoders began again is known: 0.1 m.
    """
    odometry = WheelOdometry(DifferentialBase(0.4), [0.1, 0.1], OdometryParameters())
    for i in range(3):
        odometry.update(0.1 * i, [1.0 * i, 1.0 * i])
    before = odometry.pose, odometry.covariance()
    assert odometry.update(0.4, [-900.0, -900.0]) is Succession.DOUBTED
    assert (odometry.pose, odometry.covariance()) == before
    assert odometry.update(0.5, [-899.0, -899.0]) is Succession.RESET
    assert odometry.pose == pytest.approx((0.3, 0.0, 0.0), abs=1e-12)
    assert odometry.twist == pytest.approx((1.0, 0.0, 0.0), abs=1e-9)
    assert odometry.covariance().xx == pytest.approx(0.2**2, rel=0.01)
    assert odometry.update(0.6, [-898.0, -898.0]) is Succession.MOVED
    assert odometry.pose.x == pytest.approx(0.4, abs=1e-12)


@pytest.mark.parametrize('stamp', [0.3, 0.25])
def test_duplicates_and_late_readings_move_nothing(stamp):
    odometry = WheelOdometry(OmniBase(THREE), [0.05] * 3)
    _, angles = drive(odometry, THREE, [Twist(1.0, 0.0, 0.5)] * 3)
    before = odometry.pose, odometry.covariance(), odometry.twist
    assert odometry.update(stamp, [a + 1.0 for a in angles]) in {
        Succession.DUPLICATE,
        Succession.LATE,
    }
    assert (odometry.pose, odometry.covariance(), odometry.twist) == before


def test_set_odometry_goes_on_from_there():
    odometry = WheelOdometry(DifferentialBase(0.4), [0.1, 0.1])
    odometry.update(0.0, [0.0, 0.0])
    known = Covariance(0.01, 0.0, 0.0, 0.02, 0.0, 0.03)
    odometry.set_odometry(Pose(5.0, 5.0, pi / 2), known)
    assert odometry.covariance() == pytest.approx(known, abs=1e-15)
    odometry.update(0.1, [1.0, 1.0])
    assert odometry.pose == pytest.approx((5.0, 5.1, pi / 2), abs=1e-12)
    assert odometry.covariance().xx == pytest.approx(0.01 + 0.03 * 0.1**2, rel=0.01)


def test_a_gyroscope_corrects_the_heading():
    """Wheels that skid say 0.5 rad; a gyroscope a thousand times as sure says 0.4 rad."""
    odometry = WheelOdometry(DifferentialBase(0.4), [0.1, 0.1])
    odometry.update(0.0, [0.0, 0.0])
    odometry.update(0.1, [0.0, 2.0], turn=GyroTurn(0.4, 1e-9, 0.1))
    assert odometry.pose.theta == pytest.approx(0.4, abs=1e-5)
    assert odometry.covariance().tt == pytest.approx(1e-9, rel=1e-4)


@pytest.mark.parametrize(
    ('angles', 'steering'),
    [([nan, 0.0], [0.0, 0.0]), ([0.0, 0.0], [0.0, nan]), ([0.0, 0.0], [0.0])],
)
def test_a_malformed_reading_changes_nothing(angles, steering):
    odometry = WheelOdometry(TurretBase(Turrets([(1.0, 0.0), (-1.0, 0.0)])), [0.1, 0.1])
    odometry.update(0.0, [0.0, 0.0], [0.0, 0.0])
    with pytest.raises(SignalError, match='angles'):
        odometry.update(0.1, angles, steering)
    odometry.update(0.2, [1.0, 1.0], [0.0, 0.0])
    assert odometry.pose.x == pytest.approx(0.1, abs=1e-15)


def test_steering_belongs_to_bases_that_steer():
    omni = WheelOdometry(OmniBase(THREE), [0.05] * 3)
    with pytest.raises(SignalError, match='3 steering angles given, this base has 0'):
        omni.update(0.0, [0.0] * 3, [0.0] * 3)
    turrets = WheelOdometry(TurretBase(Turrets([(1.0, 0.0), (-1.0, 0.0)])), [0.1, 0.1])
    with pytest.raises(SignalError, match='0 steering angles given, this base has 2'):
        turrets.update(0.0, [0.0, 0.0])


def test_a_wrong_number_of_radii_is_refused():
    with pytest.raises(ConfigurationError, match='2 wheel_radii for 3 wheels'):
        WheelOdometry(OmniBase(THREE), [0.05, 0.05])


def test_a_rounding_at_either_end_has_a_twelfth_of_its_square_for_variance():
    """Of 0.01 rad on the larger wheel, of 0.05 m."""
    given = OdometryParameters(encoder_resolution=0.01)
    odometry = WheelOdometry(DifferentialBase(0.4), [0.05, 0.04], given)
    assert odometry._quantum == pytest.approx(2.0 * 0.0005**2 / 12.0)  # noqa: SLF001 - by hand
