"""A limit of speed limits, whatever number it is; what is none is refused by every base."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics import omniwheel_columns, turret_columns
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Twist

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


@pytest.mark.parametrize('most', [1e-9, 0.5])
@pytest.mark.parametrize('command', COMMANDS)
def test_a_limit_below_what_is_wanted_is_reached_by_the_fastest_wheel(command, most):
    assert np.abs(command(most)).max() == pytest.approx(most)


@pytest.mark.parametrize('command', COMMANDS)
def test_an_infinite_limit_of_speed_limits_nothing(command):
    np.testing.assert_array_equal(command(inf), command(1e9))
    assert np.abs(command(inf)).max() > 0.9
