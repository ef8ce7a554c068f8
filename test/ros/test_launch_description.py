"""Launch files: where an argument is wrong nothing is started."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.ros.config import find_config
from agv_motion.ros.launch_description import check_arguments, described
from agv_motion.ros.robot_graphs import ROBOTS

WRONG = [
    ('config', '/nowhere/oak.yaml', 'no file'),
    ('config', '', 'no file'),
    ('namespace', '9oak', 'no digit first'),
    ('simulate', 'nope', 'expected true or false'),
    ('respawn', '', 'expected true or false'),
    ('use_sim_time', '2', 'expected true or false'),
    ('time_factor', 'fast', 'expected a number'),
]
"""Argument, value, and why not: launch starts the other nodes all the same, and leaves them."""


def context(robot, **given):
    arguments = {one.name: one.default for one in ROBOTS[robot].arguments}
    return SimpleNamespace(launch_configurations=arguments | given)


def test_a_configuration_is_found_by_path_and_by_name(tmp_path):
    own = tmp_path / 'oak.yaml'
    own.write_text('/**: {ros__parameters: {}}', encoding='utf-8')
    for name, path in ((str(own), own), ('omni.yaml', find_config('omni.yaml'))):
        given = context('tree', config=name)
        check_arguments(given, ROBOTS['tree'])
        assert given.launch_configurations['config'] == str(path.resolve())


def test_what_launch_takes_for_a_number_is_told_as_true():
    given = context('omni', use_sim_time='1', simulate='False', namespace='/hare/', other='kept')
    check_arguments(given, ROBOTS['omni'])
    found = given.launch_configurations
    assert [found[name] for name in ('use_sim_time', 'simulate', 'namespace', 'other')] == [
        'true', 'false', 'hare', 'kept',
    ]  # fmt: skip


@pytest.mark.parametrize('robot', ROBOTS)
@pytest.mark.parametrize(('name', 'value', 'why'), WRONG)
def test_a_wrong_argument_is_refused_before_any_node_starts(robot, name, value, why):
    with pytest.raises(ConfigurationError, match=why):
        check_arguments(context(robot, **{name: value}), ROBOTS[robot])


def test_a_file_that_is_no_parameter_file_is_refused(tmp_path):
    own = tmp_path / 'oak.yaml'
    own.write_text('track: 0.3', encoding='utf-8')
    with pytest.raises(ConfigurationError, match='outside of the parameters of any node'):
        check_arguments(context('tree', config=str(own)), ROBOTS['tree'])


@pytest.mark.parametrize(('name', 'value', 'why'), WRONG)
def test_launch_itself_starts_nothing_either(name, value, why, capfd):
    launch = pytest.importorskip('launch')
    service = launch.LaunchService(noninteractive=True)
    service.context.launch_configurations[name] = value
    service.include_launch_description(described(ROBOTS['differential']))
    assert service.run() == 1
    told = ''.join(capfd.readouterr())
    assert why in told
    assert 'process started' not in told
