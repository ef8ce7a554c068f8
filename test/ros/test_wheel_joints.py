"""Wheels as joints: whichever field tells of a wheel is used, and what is not is named."""

from __future__ import annotations

from math import inf, nan

import pytest

pytest.importorskip('rclpy')

from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError
from agv_motion.ros.messages import TurretJoints
from agv_motion.ros.wheel_joints import WheelJoints

JOINTS = WheelJoints(['left', 'right'])


def state(positions=(), velocities=(), names=('left', 'right'), effort=()):
    return JointState(name=names, position=positions, velocity=velocities, effort=effort)


@pytest.mark.parametrize(
    ('message', 'angles', 'rates'),
    [
        (state([1.0, 2.0], [3.0, 4.0]), [1.0, 2.0], [3.0, 4.0]),
        (state([1.0, 2.0], [3.0, 4.0], effort=[nan]), [1.0, 2.0], [3.0, 4.0]),
        (state([1.0, 2.0], [3.0, 4.0], ['right', 'left']), [2.0, 1.0], [4.0, 3.0]),
        (state([1.0, 2.0], [nan, inf]), [1.0, 2.0], []),
        (state([nan, nan], [3.0, 4.0]), [], [3.0, 4.0]),
        (state([nan, 2.0], [3.0, nan]), [None, 2.0], [3.0, None]),
        (state([1.0, 2.0], [3.0]), [1.0, 2.0], []),
        (state([1.0], [3.0, 4.0]), [], [3.0, 4.0]),
    ],
)
def test_the_field_that_is_of_use_is_used(message, angles, rates):
    found = JOINTS.read(message)
    assert (found.angles, found.rates) == (angles, rates)
    assert bool(found.wrong) == (None in [*angles, *rates] or not angles or not rates)


@pytest.mark.parametrize(
    ('message', 'word'),
    [
        (state([nan, nan], [nan, inf]), 'positions must be finite.*velocities must be finite'),
        (state([1.0], []), '1 positions for 2 joints'),
        (state(), 'neither positions nor velocities'),
        (state([1.0], [], ['nose']), 'set joint_names'),
    ],
)
def test_where_none_is_of_use_both_are_named(message, word):
    with pytest.raises(SignalError, match=word):
        JOINTS.read(message)


def turrets(positions, velocities):
    return JointState(name=TurretJoints(2).message().name, position=positions, velocity=velocities)


def test_of_turrets_only_what_is_needed_must_be_of_use():
    joints = TurretJoints(2)
    found = joints.read_state(turrets([0.1, 0.2, nan, nan], [nan, nan, 3.0, 4.0]))
    assert (found.angles, found.rates, found.turned) == ([0.1, 0.2], [3.0, 4.0], [])
    found = joints.read_state(turrets([0.1, 0.2, 5.0, 6.0], [0.0, 0.0, nan, 4.0]))
    assert (found.angles, found.rates, found.turned) == ([0.1, 0.2], [], [5.0, 6.0])
    assert 'wheel rates must be finite' in found.wrong
    found = joints.read_state(turrets([0.1, 0.2, 5.0, 6.0], []))
    assert (found.rates, found.wrong) == ([], '0 velocities for 4 joints: give one each')


def test_turrets_that_count_no_turns_must_tell_rates():
    with pytest.raises(SignalError, match='wheel rates must be finite'):
        TurretJoints(2).read_state(turrets([0.1, 0.2, 0.0, 0.0], [0.0, 0.0, nan, 4.0]))
    with pytest.raises(SignalError, match='turret angles must be finite'):
        TurretJoints(2).read_state(turrets([0.1, nan, 5.0, 6.0], [0.0, 0.0, 3.0, 4.0]))
