"""Fixes with the noise that they tell."""

from __future__ import annotations

import statistics
from math import pi

import pytest

from agv_motion.planar import Pose, wrap
from agv_motion.simulation.fixes import FixParameters, FixSensor

GIVEN = FixParameters(position_noise=0.2, heading_noise=0.1)


def test_errors_are_as_large_as_the_covariance_says():
    sensor = FixSensor(GIVEN, 1)
    true = Pose(1.0, -2.0, pi - 0.01)
    fixes = [sensor.measure(true) for _ in range(3000)]
    covariance = sensor.covariance()
    for place, errors in (
        (0, [fix.x - true.x for fix in fixes]),
        (7, [fix.y - true.y for fix in fixes]),
        (35, [wrap(fix.theta - true.theta) for fix in fixes]),
    ):
        assert statistics.variance(errors) == pytest.approx(covariance[place], rel=0.1)
        assert abs(statistics.fmean(errors)) < 4.0 * (covariance[place] / 3000) ** 0.5
    assert all(-pi <= fix.theta < pi for fix in fixes)
    assert sum(map(bool, covariance)) == 3


def test_without_noise_it_is_the_truth():
    sensor = FixSensor(FixParameters(position_noise=0.0, heading_noise=0.0), 1)
    assert sensor.measure(Pose(1.0, 2.0, 0.5)) == pytest.approx((1.0, 2.0, 0.5))
