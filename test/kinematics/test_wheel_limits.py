"""Limits of wheels that cannot be are refused."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.wheel_limits import WheelLimits


@pytest.mark.parametrize(('up', 'down'), [(1.0, 0.5), (0.0, 3.0)])
def test_a_robot_that_cannot_brake_as_it_speeds_up_is_refused(up, down):
    with pytest.raises(ConfigurationError, match='brake at least as hard'):
        WheelLimits(1.0, up, down)
    WheelLimits(1.0, down, 0.0)


@pytest.mark.parametrize(
    ('name', 'value'),
    [('max_wheel_speed', 0.0), ('max_wheel_acceleration', -1.0), ('max_wheel_jerk', 1e7)],
)
def test_each_limit_has_a_range(name, value):
    with pytest.raises(ConfigurationError, match=f'{name} = '):
        WheelLimits(**{name: value})


def test_by_default_there_is_no_limit_of_jerk():
    assert WheelLimits() == WheelLimits(1.0, 2.0, 4.0, 0.0)
