"""Limits of wheels that cannot be are refused."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics import omniwheel_columns, turret_columns
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.kinematics.wheel_limits import WheelLimits
from agv_motion.planar import Twist


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


TREE = Turrets.from_polar([0.0, 2.0, 4.0], [1.0] * 3)
OMNI = OmniWheels.from_polar([0.0, 2.0, 4.0], [0.2] * 3)
DRIVE = DifferentialDrive(0.5, [0.1, 0.1])
AHEAD, ROWS = Twist(1.0, 0.0, 0.0), np.array([[1.0], [0.0], [0.0]])
COMMANDS = (
    lambda most: TREE.command(AHEAD, None, most).speed,
    lambda most: OMNI.command(AHEAD, most).speed,
    lambda most: DRIVE.command(AHEAD, most).speed,
    lambda most: turret_columns.command_columns(TREE, ROWS, None, most).speed,
    lambda most: omniwheel_columns.command_columns(OMNI, ROWS, most),
)


@pytest.mark.parametrize('most', [nan, 0.0, -1.0, -inf])
@pytest.mark.parametrize('command', COMMANDS)
def test_a_limit_of_speed_that_is_none_turns_no_wheel(command, most):
    """NaN let any speed pass, or came out as speed; a limit below 0 turned the wheels round."""
    with pytest.raises(ConfigurationError, match=f'max_wheel_speed = {most} m/s: must be above 0'):
        command(most)


@pytest.mark.parametrize('command', COMMANDS)
def test_an_infinite_limit_of_speed_limits_nothing(command):
    np.testing.assert_array_equal(command(inf), command(1e9))
    assert np.abs(command(inf)).max() > 0.9
