"""The gyroscope: turns added up, bias learnt at rest, and its say beside the wheels."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.yaw_rate import GyroTurn, YawRate, YawRateParameters


def test_a_ramp_of_the_rate_is_added_up_exactly():
    """Hand calculation: from 0 to 1 rad/s within 1 s is half a radian."""
    gyroscope = YawRate()
    for i in range(11):
        gyroscope.add(0.1 * i, 0.1 * i)
    turn = gyroscope.take()
    assert turn.angle == pytest.approx(0.5, abs=1e-12)
    assert turn.duration == pytest.approx(1.0, abs=1e-12)
    assert gyroscope.take() is None


def test_the_bias_is_learnt_at_rest():
    rng, gyroscope = np.random.default_rng(1), YawRate(YawRateParameters(noise=0.002))
    for i in range(6000):
        rate = 0.01 + 0.02 * float(rng.standard_normal())  # 0.002 rad after 1 s at 100 Hz
        gyroscope.add(0.01 * i, rate, at_rest=True)
    assert abs(gyroscope.bias - 0.01) < 3 * gyroscope.bias_variance**0.5
    assert gyroscope.bias_variance**0.5 < 5e-4
    gyroscope.take()
    for i in range(6000, 6101):
        gyroscope.add(0.01 * i, 0.01)
    assert abs(gyroscope.take().angle) < 1.5e-3


def test_the_bias_is_learnt_beside_the_wheels():
    """A robot that turns at 0.5 rad/s; wheels whose turns err by 2 mrad in each 0.1 s."""
    rng, gyroscope = np.random.default_rng(1), YawRate(YawRateParameters(bias=0.05))
    for i in range(3000):
        gyroscope.add(0.1 * i, 0.53 + 0.006 * float(rng.standard_normal()))
        turn = gyroscope.take()
        if turn is not None:
            gyroscope.compare(turn, 0.05 + 0.002 * float(rng.standard_normal()), 0.002**2)
    assert abs(gyroscope.bias - 0.03) < 3 * gyroscope.bias_variance**0.5
    assert gyroscope.bias_variance**0.5 < 1e-3


def test_a_bias_that_is_not_known_is_counted_as_one_that_stays():
    """Hand calculation: 0.02 rad/s for 30 s are 0.6 rad; told is what is never less."""
    gyroscope, variance = YawRate(YawRateParameters(bias=0.02, noise=1e-7, bias_walk=0.0)), 0.0
    for i in range(301):
        gyroscope.add(0.1 * i, 0.0)
        turn = gyroscope.take()
        variance += turn.variance if turn else 0.0
    assert variance**0.5 == pytest.approx(0.02 * (30.0 * 60.0) ** 0.5, rel=1e-6)
    assert variance**0.5 > 0.6


def test_over_a_gap_and_back_in_time_it_tells_nothing():
    gyroscope = YawRate()
    gyroscope.add(0.0, 1.0)
    gyroscope.add(0.1, 1.0)
    gyroscope.add(0.05, 9.0)  # late: ignored
    gyroscope.add(0.2, 1.0)
    assert gyroscope.take().angle == pytest.approx(0.2, abs=1e-12)
    gyroscope.add(5.0, 1.0)
    assert gyroscope.take() is None


def test_the_say_of_each_is_its_information():
    """Hand calculation: 3 parts of wheels and 1 of gyroscope, x following by its correlation."""
    wheels = Covariance(0.02, 0.0, 0.01, 0.03, 0.0, 0.01)
    displacement, covariance = GyroTurn(0.4, 0.03, 0.1).correct((1.0, 2.0, 0.0), wheels, 0.1)
    assert displacement == pytest.approx((1.1, 2.0, 0.1), abs=1e-15)
    expected = (0.02 - 0.0025, 0.0, 0.0075, 0.03, 0.0, 0.0075)
    assert covariance == pytest.approx(expected, abs=1e-15)


def test_a_turn_is_stretched_to_the_time_of_the_wheels():
    displacement, _ = GyroTurn(0.2, 1e-12, 0.05).correct(
        (0, 0, 0), Covariance(1, 0, 0, 1, 0, 1), 0.1
    )
    assert displacement[2] == pytest.approx(0.4, abs=1e-9)


def test_a_rate_that_is_not_finite_is_refused():
    with pytest.raises(SignalError, match='yaw rate and its stamp must be finite'):
        YawRate().add(0.0, float('nan'))


@pytest.mark.parametrize(('duration', 'variance'), [(0.0, 1e-4), (0.1, 0.0), (-0.1, 1e-4)])
def test_a_turn_that_tells_nothing_leaves_the_bias(duration, variance):
    """Over no time, or beside wheels that are sure because they stand."""
    gyroscope = YawRate()
    known = gyroscope.bias, gyroscope.bias_variance
    gyroscope.compare(GyroTurn(0.1, 1e-4, duration), 0.0, variance)
    assert (gyroscope.bias, gyroscope.bias_variance) == known


def test_the_bias_becomes_less_sure_as_it_walks():
    """Hand calculation: variances add up, 0.01 squared and 20 s of 0.002 squared."""
    gyroscope = YawRate(YawRateParameters(bias=0.01, bias_walk=0.002))
    for i in range(201):
        gyroscope.add(0.1 * i, 0.3)
    assert gyroscope.bias_variance == pytest.approx(0.01**2 + 20.0 * 0.002**2)
