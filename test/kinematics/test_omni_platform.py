"""The omnidirectional base as it is declared."""

from __future__ import annotations

from math import pi

import pytest

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.kinematics.omni_platform import OmniBaseParameters
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.planar import Twist

ROWS = ('wheel_angles', 'wheel_distances', 'wheel_directions', 'slide_angles', 'wheel_radii')


def test_the_wheels_stand_at_their_angles_and_distances():
    """The first at 30 degrees and 0.2 m: (0.173, 0.1), driving clockwise, so the robot turns so."""
    wheels = OmniWheels.of(OmniBaseParameters())
    speeds = wheels.command(Twist(0.0, 0.0, 1.0)).speed
    assert list(speeds) == pytest.approx([-0.2, -0.2, -0.2])
    ahead = wheels.command(Twist(1.0, 0.0, 0.0)).speed
    assert list(ahead) == pytest.approx([0.5, 0.5, -1.0])


@pytest.mark.parametrize('row', [*ROWS, 'joint_names'])
def test_every_wheel_needs_all_of_it(row):
    short = getattr(OmniBaseParameters(), row)[:2]
    with pytest.raises(ConfigurationError, match=f'2 {row}.*give all six of every wheel'):
        OmniBaseParameters(**{row: short})


def test_no_two_wheels_bear_one_name():
    with pytest.raises(ConfigurationError, match='two wheels bear the same name'):
        OmniBaseParameters(joint_names=('a', 'b', 'a'))


def test_wheels_that_leave_a_motion_open_are_refused():
    parallel = OmniBaseParameters(wheel_directions=(0.0, 0.0, 0.0), slide_angles=(pi / 2,) * 3)
    with pytest.raises(GeometryError, match='no wheel turns when the base moves'):
        OmniWheels.of(parallel)
