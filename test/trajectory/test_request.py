"""What is asked of a trajectory: what is refused, and what no ramp means."""

from __future__ import annotations

from math import inf, nan

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory.bounds import AT_ONCE, NO_RAMP
from agv_motion.trajectory.request import Request


def test_no_ramp_is_one_without_end():
    assert Request(NO_RAMP, 1.0).acceleration == AT_ONCE
    assert Request(0.4, 1.0).acceleration == 0.4


@pytest.mark.parametrize('bad', [-0.1, 1e-12, inf, nan])
def test_a_ramp_that_cannot_be_meant_is_refused(bad):
    with pytest.raises(ConfigurationError, match=r'speed_ramps = .*for no ramp give 0'):
        Request(bad, 1.0)


@pytest.mark.parametrize('bad', [0.0, -1.0, 1e7, inf, nan])
def test_so_is_a_speed(bad):
    with pytest.raises(ConfigurationError, match='cruising_speed'):
        Request(1.0, bad)


@pytest.mark.parametrize('bad', [-0.1, 5.1, nan])
def test_and_a_curve(bad):
    with pytest.raises(ConfigurationError, match=r'0\.3 to 0\.6 is usual'):
        Request(1.0, 1.0, bad)


def test_what_is_not_asked_for_is_straight_and_forward():
    asked = Request(0.4, 0.4)
    assert (asked.delta_curve, asked.backward) == (0.0, False)
