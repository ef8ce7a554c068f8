"""The polar command: hand calculation, inverse, and its domain."""

from __future__ import annotations

from math import atan2, inf, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.kinematics.turrets import Turrets
from agv_motion.motion.command.polar import (
    PolarCommand,
    checked,
    polar_command,
    to_polar,
    to_twist,
)
from agv_motion.planar import Pose, Twist

COMMANDS = st.builds(
    PolarCommand,
    st.floats(0.0, 1.0),
    st.floats(-pi, pi, exclude_max=True),
    st.floats(-1.0, 1.0),
)


def test_full_speed_to_the_left_while_turning():
    """Hand calculation: 1 m/min along y; omega = 1 carries the rim at 1 m/min."""
    twist = to_twist(PolarCommand(1.0, pi / 2, 1.0))
    assert twist == pytest.approx((0.0, 1.0 / 60.0, 1.0 / 60.0 / 1.18), abs=1e-17)


def test_the_heading_is_the_bearing_seen_from_the_platform():
    """At (1, 1) looking along y, the goal (4, 5) bears atan2(4, 3)."""
    command = polar_command(Pose(1.0, 1.0, pi / 2), (4.0, 5.0), 0.4, 0.5)
    assert command == pytest.approx((0.4, atan2(4.0, 3.0) - pi / 2, 0.5))


PLACES = st.floats(-50, 50)


@given(st.builds(Pose, PLACES, PLACES, st.floats(-pi, pi - 1e-9)), st.tuples(PLACES, PLACES))
def test_every_pose_and_target_give_a_heading_in_its_domain(pose, target):
    checked(polar_command(pose, target, 1.0, -1.0))


@given(COMMANDS.filter(lambda command: command.v > 1e-6))
def test_the_way_back(command):
    back = to_polar(to_twist(command))
    assert back == pytest.approx(command, abs=1e-12)


@given(COMMANDS)
def test_no_wheel_is_asked_for_more_than_twice_the_trunk_speed(command):
    """|v| + |omega| <= 2: with wheels of 2 m/min nothing has to be scaled."""
    tree = Turrets([(0.834, -0.834), (0.834, 0.834), (-1.18, 0.0)])
    assert max(tree.command(to_twist(command), [0.0] * 3).speed) <= 2.0 / 60.0 * (1 + 1e-3)


@pytest.mark.parametrize(
    ('command', 'word'),
    [
        ((nan, 0, 0), 'finite'), ((0, inf, 0), 'finite'), ((1.01, 0, 0), 'v = 1.01'),
        ((-0.1, 0, 0), 'v = -0.1'), ((0, pi, 0), 'theta'), ((0, 0, -1.5), 'omega = -1.5'),
        ((0, 0, 1.5), 'omega = 1.5'),
    ],
)  # fmt: skip
def test_what_lies_outside_is_refused(command, word):
    with pytest.raises(SignalError, match=word):
        checked(PolarCommand(*command))


@given(COMMANDS)
def test_what_lies_inside_passes(command):
    assert checked(command) is command


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_no_number_that_is_none_is_handed_on(bad):
    for part in range(3):
        numbers = [bad if i == part else 0.5 for i in range(3)]
        with pytest.raises(SignalError, match=r'polar command .* must be finite'):
            to_twist(PolarCommand(*numbers))
        with pytest.raises(SignalError, match=r'twist .* must be finite'):
            to_polar(Twist(*numbers))
