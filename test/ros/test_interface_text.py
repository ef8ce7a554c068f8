"""Interfaces are shown as `ros2 interface show` shows them, its oddities included."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.ros import interface_text

OWN = """# What it is

Inner inner  # the [m] inner one
own_msgs/Inner[3] three
string<=5 text
int8 A = -1        # unable [m]
#
"""
INNER = '# Hidden\n\nfloat64 x    # meters\n\t# indented\nbuiltin/Time t\n'


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Install two interfaces, and one of another package."""
    for package, name, text in (
        ('own_msgs', 'Own', OWN), ('own_msgs', 'Inner', INNER), ('builtin', 'Time', 'int32 sec\n'),
    ):  # fmt: skip
        folder = tmp_path / 'share' / package / 'msg'
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f'{name}.msg').write_text(text)
        index = tmp_path / 'share/ament_index/resource_index/rosidl_interfaces'
        index.mkdir(parents=True, exist_ok=True)
        with (index / package).open('a') as file:
            file.write(f'msg/{name}.idl\nmsg/{name}.msg\n')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))


TIME = ['\t\tint32 sec']
INNER_BARE = ['\tfloat64 x    #', '\t\t# indented', '\tbuiltin/Time t', *TIME]


def test_comments_of_the_type_itself(own):
    assert list(interface_text.lines('own_msgs/msg/Own')) == [
        '# What it is', '', 'Inner inner  # the [m] inner one', *INNER_BARE,
        'own_msgs/Inner[3] three', *INNER_BARE,
        'string<=5 text', 'int8 A = -1        # unable [m]', '#',
    ]  # fmt: skip


def test_no_comments(own):
    """As in the genuine tool the # stays; what that makes of a unit within a comment does not."""
    assert list(interface_text.lines('own_msgs/msg/Own', comments=False)) == [
        'Inner inner  #', *INNER_BARE, 'own_msgs/Inner[3] three', *INNER_BARE,
        'string<=5 text', 'int8 A = -1        #', '#',
    ]  # fmt: skip


def test_all_comments(own):
    lines = list(interface_text.lines('own_msgs/msg/Own', nested_comments=True))
    assert '\t# Hidden' in lines
    assert '\tfloat64 x    # meters' in lines


def test_what_is_installed(own):
    names = interface_text.installed('msg')
    assert names[: names.index('own_msgs/msg/Own') + 1][-2:] == [
        'own_msgs/msg/Inner', 'own_msgs/msg/Own',
    ]  # fmt: skip


@pytest.mark.parametrize(
    ('name', 'words'),
    [
        ('own_msgs/Own', "three parts.*did you mean 'own_msgs/msg/Own'"),
        ('own_msgs/msg/Oven', "Could not find .*did you mean 'own_msgs/msg/Own'"),
        ('own_msgs/msg/../msg/Own', 'three parts'),
    ],
)
def test_what_is_not(own, name, words):
    with pytest.raises(ConfigurationError, match=words):
        list(interface_text.lines(name))
