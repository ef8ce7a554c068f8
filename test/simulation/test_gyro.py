"""A gyroscope: its bias, and noise that averages out over time."""

from __future__ import annotations

import statistics

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.simulation.gyro import Gyro, GyroParameters


def test_without_noise_it_tells_the_truth_and_its_bias():
    gyro = Gyro(GyroParameters(noise=0.0, bias=-0.01), 1)
    assert gyro.measure(0.5, 0.02) == pytest.approx(0.49)


@pytest.mark.parametrize('duration', [0.01, 1.0, 4.0])
def test_the_turn_is_off_by_the_noise_times_the_root_of_the_time(duration):
    gyro = Gyro(GyroParameters(noise=0.002, bias=0.0), 1)
    turns = [gyro.measure(0.0, duration) * duration for _ in range(2000)]
    assert statistics.stdev(turns) == pytest.approx(0.002 * duration**0.5, rel=0.06)
    assert abs(statistics.fmean(turns)) < 3 * 0.002 * (duration / 2000) ** 0.5


def test_a_seed_belongs_to_its_noise():
    one, other, third = (Gyro(GyroParameters(), seed) for seed in (1, 1, 2))
    assert one.measure(0.1, 0.1) == other.measure(0.1, 0.1) != third.measure(0.1, 0.1)


def test_noise_is_not_negative():
    with pytest.raises(ConfigurationError, match='noise'):
        GyroParameters(noise=-0.1)
