"""What nodes say of files: content only of those that whoever started the node named."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.errors import ConfigurationError
from agv_motion.ros.config import config_folders
from agv_motion.ros.quotation import told


def refused(path):
    return ConfigurationError.at((path, 1, 2), "'secret' is no pair", 'no pair')


def test_a_file_is_quoted_only_to_who_named_it_at_the_start(tmp_path):
    (tmp_path / 'mine').touch()
    (tmp_path / 'link').symlink_to(tmp_path / 'mine')
    error = refused(tmp_path / 'mine')
    assert told(error, ()) == f'{tmp_path / "mine"}, line 1, column 2: no pair'
    assert told(error, ('', 'base_link', str(tmp_path / 'mine'))) == str(error)
    assert told(error, (str(tmp_path / 'link'),)) == str(error)
    assert told(error, (str(tmp_path),)) == error.unquoted


def test_the_configuration_is_quoted_and_what_a_link_in_it_leads_to_is_not(tmp_path, monkeypatch):
    folder = config_folders()[-1]
    assert 'secret' in told(refused(folder / 'zone_indoor.yaml'), ())
    assert 'secret' not in told(refused(folder / '..' / 'README.md'), ())
    (tmp_path / 'config').mkdir()
    (tmp_path / 'other').touch()
    (tmp_path / 'config' / 'link').symlink_to(tmp_path / 'other')
    monkeypatch.setattr('agv_motion.ros.quotation.config_folders', lambda: [tmp_path / 'config'])
    assert 'secret' not in told(refused(tmp_path / 'config' / 'link'), ())


def test_other_errors_are_told_as_they_are():
    assert told(ConfigurationError("x = 'a': choose one of b"), ()) == "x = 'a': choose one of b"
