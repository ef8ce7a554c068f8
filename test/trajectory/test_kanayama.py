"""Kanayama's law by hand; what holds of every law is in test_tracking.py."""

from __future__ import annotations

from math import cos, sin

import pytest

from agv_motion.trajectory.kanayama import Kanayama, KanayamaGains
from agv_motion.trajectory.motion import STILL, Speeds
from agv_motion.trajectory.tracking import TrackingError

LAW = Kanayama(KanayamaGains(3.0, 5.0, 7.0, 2.0))
ERROR = TrackingError(0.1, -0.2, 0.3)


@pytest.mark.parametrize('speed', [0.4, -0.4])
def test_by_equation_1(speed):
    """Backwards the error across counts the other way round, that of the heading does not."""
    twist = LAW.twist(ERROR, Speeds(speed, 0.5))
    assert twist.vx == pytest.approx(speed * cos(0.3) + 0.3)
    assert twist.vy == 0.0
    assert twist.wz == pytest.approx(0.5 - speed * 1.0 + (0.4 * 7.0 + 2.0) * sin(0.3))


def test_at_rest_the_place_across_is_out_of_reach():
    assert LAW.twist(ERROR, STILL) == pytest.approx((0.3, 0.0, 2.0 * sin(0.3)))


def test_its_lyapunov_function_and_damping_by_hand():
    assert LAW.lyapunov(ERROR) == pytest.approx(0.5 * (0.01 + 0.04) + (1.0 - cos(0.3)) / 5.0)
    assert KanayamaGains(across=4.0, heading=2.0).damping == pytest.approx(0.5)
