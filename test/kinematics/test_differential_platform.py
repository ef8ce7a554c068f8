"""The differential base as it is declared."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters, TrackParameters
from agv_motion.planar import Twist


def test_a_calibrated_track_turns_the_robot():
    """Half a metre between the wheels, 0.3 m times two by calibration 0.6: the rims go 0.3 m/s."""
    assert TrackParameters(0.5, 1.2).effective_track == pytest.approx(0.6)
    drive = DifferentialDrive.of(DifferentialBaseParameters(0.5, 1.2, (0.1, 0.2)))
    left, right = drive.command(Twist(0.0, 0.0, 1.0)).speed
    assert (left, right) == pytest.approx((-0.3, 0.3))


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ({'wheel_radii': (0.1,)}, r'wheel_radii = \[0.1\]: give two, left and right'),
        ({'wheel_radii': (0.1, 0.1, 0.1)}, 'give two'),
        ({'joint_names': ('one',)}, 'joint_names'),
        ({'joint_names': ('one', 'one')}, 'two wheels bear the same name'),
        ({'wheel_radii': (0.1, -0.1)}, 'wheel_radii'),
        ({'track': 0.0}, 'track'),
    ],
)
def test_two_wheels_with_names_of_their_own(given, words):
    with pytest.raises(ConfigurationError, match=words):
        DifferentialBaseParameters(**given)
