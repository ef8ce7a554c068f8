"""The law of robots that go sideways by hand; what holds of every law is in test_tracking.py."""

from __future__ import annotations

from math import cos, sin

import pytest

from agv_motion.trajectory.holonomic import Holonomic, HolonomicGains
from agv_motion.trajectory.motion import Speeds
from agv_motion.trajectory.tracking import TrackingError

LAW, ERROR = Holonomic(HolonomicGains(3.0, 5.0)), TrackingError(0.1, -0.2, 0.3)


@pytest.mark.parametrize('speed', [0.4, -0.4])
def test_by_equation_1(speed):
    twist = LAW.twist(ERROR, Speeds(speed, 0.5))
    assert twist == pytest.approx((speed * cos(0.3) + 0.3, speed * sin(0.3) - 0.6, 2.0))


def test_its_lyapunov_function_by_hand():
    assert LAW.lyapunov(ERROR) == pytest.approx(0.5 * (0.01 + 0.04 + 0.09))
    assert Holonomic.goes_sideways
