"""Links and joints: one tree, and where each joint holds its link, by hand."""

from __future__ import annotations

from math import nan, pi, sqrt

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.model.robot_model import JointKind, RobotJoint, RobotLink, RobotModel, unit

LINKS = [RobotLink(name) for name in ('base', 'mast', 'turret', 'fork')]
MAST = RobotJoint('mast_joint', JointKind.FIXED, 'base', 'mast', (0.0, 0.0, 1.5))
TURRET = RobotJoint(
    'steer', JointKind.CONTINUOUS, 'base', 'turret', (1.0, 0.5, 0.1), axis=(0.0, 0.0, 1.0)
)
FORK = RobotJoint('lift', JointKind.PRISMATIC, 'mast', 'fork', (0.2, 0.0, 0.0), (0.0, 0.0, pi / 2))
JOINTS = [MAST, TURRET, FORK]


def test_a_joint_turns_about_its_axis_or_slides_along_it():
    """A quarter turn about z is (0, 0, sin 45, cos 45 degrees); the fork's x looks to the left."""
    place, rotation = TURRET.at(pi / 2)
    assert place == (1.0, 0.5, 0.1)
    assert rotation == pytest.approx((0.0, 0.0, sqrt(0.5), sqrt(0.5)))
    place, rotation = FORK.at(0.3)
    assert place == pytest.approx((0.2, 0.3, 0.0))
    assert rotation == pytest.approx((0.0, 0.0, sqrt(0.5), sqrt(0.5)))
    assert MAST.at(9.0) == MAST.at(0.0)


def test_what_is_fixed_is_told_apart_from_what_moves():
    model = RobotModel('oak', LINKS, JOINTS)
    assert model.root == 'base'
    assert list(model.moving) == ['steer', 'lift']
    (fixed,) = model.fixed(7, 'oak/')
    assert (fixed.stamp, fixed.parent, fixed.child) == (7, 'oak/base', 'oak/mast')
    moved = list(model.moved(8, '', {'lift': 0.1, 'steer': nan, 'no_such': 1.0, 'mast_joint': 1.0}))
    assert [(one.parent, one.child) for one in moved] == [('mast', 'fork')]


@pytest.mark.parametrize(
    ('links', 'joints', 'word'),
    [
        ([*LINKS, LINKS[0]], JOINTS, "two links 'base'"),
        (LINKS, [*JOINTS, MAST._replace(child='fork')], "two joints 'mast_joint'"),
        (LINKS, [*JOINTS, MAST._replace(name='b', parent='fork')], "joints for the link 'mast'"),
        (LINKS[:3], JOINTS, "the link 'fork', which there is not"),
        (LINKS, JOINTS[:2], r"hang on \['base', 'fork'\], not on one"),
        (LINKS, [*JOINTS, MAST._replace(name='b', parent='fork', child='base')], 'in a circle'),
        (LINKS, [TURRET, FORK, MAST._replace(parent='fork')], 'hangs on itself'),
    ],
)
def test_what_is_no_tree_is_refused(links, joints, word):
    with pytest.raises(ConfigurationError, match=word):
        RobotModel('oak', links, joints)


def test_an_axis_has_length_one_or_is_none():
    assert unit('steer', (0.0, 3.0, -4.0)) == pytest.approx((0.0, 0.6, -0.8))
    for axis in ((0.0, 0.0, 0.0), (nan, 0.0, 1.0), (1e-10, 0.0, 0.0)):
        with pytest.raises(ConfigurationError, match=r"joint 'steer': its axis .* no direction"):
            unit('steer', axis)
