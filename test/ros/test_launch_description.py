"""Launch files: a configuration that is not there starts nothing."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.ros.config import find_config
from agv_motion.ros.launch_description import described, find_given_config
from agv_motion.ros.robot_graphs import ROBOTS


def context(config):
    return SimpleNamespace(launch_configurations={'config': config})


def test_a_configuration_is_found_by_path_and_by_name(tmp_path):
    own = tmp_path / 'oak.yaml'
    own.write_text('/**: {ros__parameters: {}}', encoding='utf-8')
    for name, path in ((str(own), own), ('omni.yaml', find_config('omni.yaml'))):
        given = context(name)
        find_given_config(given)
        assert given.launch_configurations == {'config': str(path)}


@pytest.mark.parametrize('name', ['/nowhere/oak.yaml', ''])
def test_without_its_configuration_nothing_is_started(name):
    with pytest.raises(ConfigurationError, match='no file'):
        find_given_config(context(name))


@pytest.mark.parametrize('robot', ROBOTS)
def test_launch_itself_starts_nothing_either(robot):
    launch = pytest.importorskip('launch')
    service = launch.LaunchService(argv=['config:=/nowhere/oak.yaml'], noninteractive=True)
    service.context.launch_configurations['config'] = '/nowhere/oak.yaml'
    service.include_launch_description(described(ROBOTS[robot]))
    assert service.run() == 1
