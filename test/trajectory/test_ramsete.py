"""The law of Samson and De Luca by hand; what holds of every law is in test_tracking.py."""

from __future__ import annotations

from math import cos, sin, sqrt

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory.motion import Speeds
from agv_motion.trajectory.ramsete import Ramsete, RamseteGains
from agv_motion.trajectory.tracking import TrackingError

LAW = Ramsete(RamseteGains(5.0, 0.7, 2.0))


@pytest.mark.parametrize('speed', [0.4, -0.4])
def test_by_equation_1(speed):
    gain = sqrt(1.4**2 * (0.25 + 5.0 * 0.16) + 4.0)
    twist = LAW.twist(TrackingError(0.1, -0.2, 0.3), Speeds(speed, 0.5))
    assert twist.vx == pytest.approx(speed * cos(0.3) + gain * 0.1)
    assert twist.vy == 0.0
    assert twist.wz == pytest.approx(0.5 + gain * 0.3 + 5.0 * speed * sin(0.3) / 0.3 * -0.2)


def test_small_headings_join_the_others():
    """sin(x) / x by its series below a limit, by itself above."""
    for heading in (1e-3, 1e-4, 1e-5, 1e-6, 0.0, -1e-5):
        twist = LAW.twist(TrackingError(0.0, 1.0, heading), Speeds(1.0, 0.0))
        gain = sqrt(1.4**2 * 5.0 + 4.0)
        series = 5.0 * (1.0 - heading * heading / 6.0)
        assert twist.wz == pytest.approx(series + gain * heading, rel=1e-12)


@pytest.mark.parametrize('zeta', [0.0, 1.0])
def test_damping_is_between_0_and_1_and_neither(zeta):
    with pytest.raises(ConfigurationError, match=f'zeta = {zeta}: must lie between 0 and 1'):
        RamseteGains(zeta=zeta)


def test_its_lyapunov_function_by_hand():
    value = LAW.lyapunov(TrackingError(0.1, -0.2, 0.3))
    assert value == pytest.approx(0.5 * (5.0 * 0.05 + 0.09))
