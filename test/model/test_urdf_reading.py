"""A URDF of anybody is read, or refused with a reason; it never fills the memory."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.model.robot_model import JointKind
from agv_motion.model.urdf_reading import read_urdf

LINKS = '<link name="a"/><link name="b"/>'


def joint(kind='continuous', inside='', parent='a', child='b', name='j'):
    return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/>'
            f'<child link="{child}"/>{inside}</joint>')  # fmt: skip


def robot(*parts):
    return f'<?xml version="1.0"?><!-- by hand --><robot name="r">{"".join(parts)}</robot>'


def test_what_is_left_out_is_as_urdf_has_it():
    (found,) = read_urdf(robot(LINKS, joint())).joints
    assert (found.place, found.angles, found.axis) == ((0, 0, 0), (0, 0, 0), (1, 0, 0))


def test_an_axis_of_any_length_is_a_direction():
    (found,) = read_urdf(robot(LINKS, joint('prismatic', '<axis xyz="0 0 -4"/>'))).joints
    assert found.kind is JointKind.PRISMATIC
    assert found.at(2.0)[0] == (0.0, 0.0, -2.0)


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        ('', 'no XML'), ('<robot', 'no XML'), ('<a/>', '<a>'),
        (robot(), 'not on one'),
        (robot(LINKS), 'not on one'),
        (robot(LINKS, joint(parent='c')), "'c', which there is not"),
        (robot(LINKS, joint(), joint(name='k')), "joints for the link 'b'"),
        (robot(LINKS, '<link name="a"/>', joint()), "two links 'a'"),
        (robot(LINKS, joint(), joint(name='k', parent='b', child='a')), 'circle'),
        (robot(LINKS, '<link name="c"/>', joint(), joint(name='j', child='c')), "joints 'j'"),
        (robot(LINKS, joint('floating')), "type 'floating'"),
        (robot(LINKS, joint(inside='<axis xyz="0 0 0"/>')), 'no direction'),
        (robot(LINKS, joint(inside='<axis xyz="0 nan 0"/>')), 'no three numbers'),
        (robot(LINKS, joint(inside='<origin xyz="0 0"/>')), 'no three numbers'),
        (robot(LINKS, '<joint name="j" type="fixed"/>'), 'no <parent>'),
        (robot('<link/>'), 'has no name'),
        ('<!DOCTYPE r [<!ENTITY a "aaaa">]><robot name="&a;"/>', 'no entities'),
        (robot(*[f'<joint name="j{i}" type="fixed"/>' for i in range(2001)]), 'at most 2000'),
    ],
)  # fmt: skip
def test_what_is_none_is_refused_with_a_reason(text, words):
    with pytest.raises(ConfigurationError, match=words):
        read_urdf(text)
