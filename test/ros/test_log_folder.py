"""Where the folder of the logs cannot be written they are kept elsewhere, and that is said."""

from __future__ import annotations

import os
import re
import tempfile
from pathlib import Path

import pytest

import agv_motion
from agv_motion.ros.log_folder import keep_logs, log_folder

ROOT = Path(agv_motion.__file__).parent


@pytest.fixture
def folders(tmp_path, monkeypatch):
    for name in ('ROS_LOG_DIR', 'ROS_HOME'):
        monkeypatch.setenv(name, '')  # what the code sets is taken back, too
    monkeypatch.setenv('HOME', str(tmp_path / 'home'))
    (tmp_path / 'tmp').mkdir()
    monkeypatch.setattr(tempfile, 'gettempdir', lambda: str(tmp_path / 'tmp'))
    return tmp_path


@pytest.mark.parametrize(
    ('name', 'within'), [('HOME', '.ros/log'), ('ROS_HOME', 'log'), ('ROS_LOG_DIR', '')]
)
def test_the_folder_is_that_of_ros(folders, monkeypatch, capsys, name, within):
    monkeypatch.setenv(name, str(folders / 'own'))
    assert log_folder() == folders / 'own' / within
    keep_logs()
    assert not os.environ['ROS_LOG_DIR'] or name == 'ROS_LOG_DIR'
    assert capsys.readouterr().err == ''


@pytest.mark.parametrize('name', ['HOME', 'ROS_HOME', 'ROS_LOG_DIR'])
def test_one_that_cannot_be_made_is_replaced_and_told(folders, monkeypatch, capsys, name):
    (folders / 'file').write_text('')
    monkeypatch.setenv(name, str(folders / 'file' / 'logs'))
    keep_logs()
    other = folders / 'tmp' / f'ros_log_{os.getuid()}'
    assert os.environ['ROS_LOG_DIR'] == str(other)
    assert other.is_dir()
    said = capsys.readouterr().err
    assert str(folders / 'file' / 'logs') in said
    assert 'Not a directory' in said
    assert said.count('\n') == 1
    keep_logs()
    assert capsys.readouterr().err == ''


def test_one_that_may_not_be_written_is_replaced_too(folders, monkeypatch, capsys):
    monkeypatch.setattr(os, 'access', lambda *_: False)
    keep_logs()
    assert 'may not be written' in capsys.readouterr().err


def test_whoever_begins_a_context_has_looked_at_the_folder():
    begins = [
        str(path.relative_to(ROOT))
        for path in ROOT.rglob('*.py')
        if re.search(r'\brclpy\.init\(', path.read_text())
    ]
    assert begins == ['ros/context.py']
