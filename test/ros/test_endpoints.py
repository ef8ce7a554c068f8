"""Classes of messages by name: those of interfaces, and nothing else of Python."""

from __future__ import annotations

import re
import sys

import pytest
from geometry_msgs.msg import Twist
from std_srvs.srv import Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.ros.endpoints import interface_module, message_class


def test_a_class_is_found_by_each_form_of_its_name():
    assert message_class('geometry_msgs/msg/Twist') is Twist
    assert message_class('geometry_msgs/Twist') is Twist
    assert message_class('std_srvs/srv/Trigger') is Trigger


@pytest.mark.parametrize(
    'name',
    ['geometry_msgs/msg/Twister', 'geometry_msgs/srv/Twist', 'no_msgs/msg/A', 'sys/msg/path'],
)
def test_what_is_no_interface_is_not_installed(name):
    package = name.partition('/')[0]
    said = f"message type '{name}' is not installed: install {package}, or source its workspace"
    with pytest.raises(ConfigurationError, match=re.escape(said)):
        message_class(name)


def test_no_code_runs_for_the_name_of_a_type(tmp_path, monkeypatch):
    """Neither a module, nor a package that has no such folder, nor one before a dot."""
    monkeypatch.syspath_prepend(tmp_path)
    runs = f"open({str(tmp_path / 'ran')!r}, 'w')\n"
    (tmp_path / 'lone_module.py').write_text(runs)
    for place in ('without_folder', 'before_the_dot'):
        (tmp_path / place).mkdir()
        (tmp_path / place / '__init__.py').write_text(runs)
    (tmp_path / 'before_the_dot/inner/msg').mkdir(parents=True)
    (tmp_path / 'before_the_dot/inner/msg/__init__.py').write_text('')
    for package in ('lone_module', 'without_folder', 'before_the_dot.inner', '__main__', ''):
        with pytest.raises(ModuleNotFoundError, match=f'{package} has no msg'):
            interface_module(package, 'msg')
        assert package not in sys.modules or package == '__main__'
    assert not (tmp_path / 'ran').exists()
