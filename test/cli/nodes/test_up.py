"""`agv up`: the nodes of a robot, with the arguments of its launch file."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from dataclasses import replace

import pytest
import yaml

pytest.importorskip('rclpy')

from agv_motion.cli.nodes.up import FORMAT, arguments, command, teller
from agv_motion.errors import ConfigurationError
from agv_motion.nodes.catalogue import available, parameters_of
from agv_motion.ros.robot_graphs import ROBOTS


def words_of(robot, name, folder, *words):
    """Return the words that start a node, and the parameters beside those of the file."""
    graph = ROBOTS[robot]
    (node,) = (one for one in graph.nodes if one.name == name)
    given = arguments(graph, words)
    started = command(node, given, folder)
    return started, yaml.safe_load((folder / f'{name}.yaml').read_text())


@pytest.mark.parametrize('robot', ROBOTS)
def test_every_node_is_one_of_the_package(robot):
    names = [node.name for node in ROBOTS[robot].nodes]
    assert set(names) <= set(available())
    assert len(set(names)) == len(names)
    told = {one.name for one in ROBOTS[robot].arguments}
    assert {node.condition for node in ROBOTS[robot].nodes if node.condition} <= told


@pytest.mark.parametrize(
    'words',
    [
        ('--namespace', 'oak', '--time-factor=10', '--state', '/x'),
        ('namespace:=oak', 'time_factor:=10', 'state:=/x'),
        ('--namespace=/oak/', '--time_factor', '10.0', 'state:=/x'),
    ],
)
def test_arguments_come_as_words_of_either_tool(tmp_path, words):
    started, values = words_of('tree', 'simulator', tmp_path, *words)
    assert values == {'/oak/simulator': {'ros__parameters': {'time_factor': 10.0, 'clock': 'lead'}}}
    assert started[1:4] == ['-m', 'agv_motion.nodes.simulator', '--ros-args']
    assert started[6:8] == ['-r', '__ns:=/oak']
    assert started[-3].endswith('config/tree.yaml')  # the file first, what is given here counts
    _, values = words_of('tree', 'arbiter', tmp_path, *words)
    own = values['/oak/arbiter']['ros__parameters']
    assert own == {'use_sim_time': True, 'state_file': '/x/oak/arbiter.json'}


def test_drivers_drive_through_the_arbiter(tmp_path):
    started, _ = words_of('differential', 'sequence', tmp_path, 'pose:=pose')
    assert 'cmd_vel:=cmd_vel/sequence' in started
    assert 'pose:=pose' in started


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (('--namespac', 'oak'), "did you mean 'namespace'?"),
        (('--namespace',), "'--namespace': write --name value, or name:=value"),
        (('oak',), "'oak': write --name value, or name:=value"),
        (('config:=/no/such.yaml',), '/no/such.yaml'),
        (('namespace:=1oak',), "namespace = '1oak': write letters, digits and _"),
        (('--namespace', 'an oak'), "namespace = 'an oak'"),
        (('--namespace', 'oak//ash'), "namespace = 'oak//ash'"),
        (('time_factor:=-1',), 'time_factor = -1'),
        (('time_factor:=nan',), 'time_factor = nan'),
        (('time_factor:=fast',), "time_factor = 'fast': expected a number"),
        (('source:=seriel',), "source = 'seriel'"),
        (('clock:=',), "clock = ''"),
    ],
)
def test_mistakes(words, error):
    with pytest.raises(ConfigurationError, match=error.replace('?', r'\?')):
        arguments(ROBOTS['tree'], words)


def test_a_file_that_no_node_can_read_is_told_once(tmp_path):
    (tmp_path / 'oak.yaml').write_text('a: [1,')
    with pytest.raises(ConfigurationError, match='no YAML'):
        arguments(ROBOTS['tree'], [f'config:={tmp_path / "oak.yaml"}'])


def test_what_no_node_that_is_started_takes_counts_nothing():
    words = 'simulate:=false', 'time_factor:=-1'
    assert arguments(ROBOTS['tree'], words)['time_factor'] == '-1'
    assert arguments(ROBOTS['omni'], ['namespace:=/yard/oak/'])['namespace'] == 'yard/oak'


def test_what_is_no_truth(alone):
    status, _, errors = alone('up', 'tree', 'simulate:=perhaps')
    assert (status, errors) == (1, "error: simulate = 'perhaps': expected true or false\n")
    status, _, errors = alone('up', 'tre')
    assert status == 1
    assert "did you mean 'tree'?" in errors
    assert "'source': where the readings" in alone('up', 'tree', '--show-args')[1]


@pytest.mark.parametrize('robot', ROBOTS)
def test_every_node_takes_what_it_is_started_with(robot, tmp_path):
    for node in ROBOTS[robot].nodes:
        _, values = words_of(robot, node.name, tmp_path)
        own = values[f'/{node.name}']['ros__parameters']
        assert own.pop('use_sim_time', True) is True
        known = parameters_of(node.name)()
        assert {n: type(v) for n, v in own.items()} == {n: type(getattr(known, n)) for n in own}
        replace(known, **own)  # refuses what cannot be


UP = ('arbiter', 'omni_kinematics', 'localization', 'omni_simulator')
"""Nodes of the robot below: those that its wheels need; each costs a second of processor"""

PROGRAM = f"""
from agv_motion.cli.main import main
from agv_motion.ros.robot_graphs import ROBOTS

nodes = tuple(node for node in ROBOTS['omni'].nodes if node.name in {UP})
ROBOTS['omni'] = ROBOTS['omni']._replace(nodes=nodes)
main()
"""


def test_a_robot_is_up_and_ends_with_its_wheels_at_rest(tmp_path):
    words = 'up', 'omni', '--namespace', 'ant', f'state:={tmp_path}'
    process = subprocess.Popen(  # noqa: S603 - our own command
        [sys.executable, '-c', PROGRAM, *words],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    lines = []
    while not any(line.startswith('[omni_kinematics]') and 'active: ' in line for line in lines):
        lines.append(process.stdout.readline())
        assert process.poll() is None, lines
    process.send_signal(signal.SIGINT)
    rest, errors = process.communicate(timeout=60.0)
    assert (process.returncode, errors) == (0, ''), rest
    names = {line.partition(']')[0].strip('[') for line in [*lines, *rest.splitlines()]}
    assert {'omni_kinematics', 'localization'} <= names <= set(UP)


def test_on_a_terminal_good_news_is_short(monkeypatch, capsys):
    environment = {}
    monkeypatch.setattr(os, 'environ', environment)
    monkeypatch.setattr(sys.stdout, 'isatty', lambda: True)
    tell = teller()
    assert environment == {FORMAT: '{severity}: {message}'}
    tell('[differential_kinematics] INFO: active: cmd_vel, wheels/state -> wheels/command, odom')
    tell('[omni_kinematics] WARN: active, but nobody publishes cmd_vel yet')
    assert capsys.readouterr().out.splitlines() == [
        '[differential_kinematics] active: cmd_vel, wheels/state -> wheels/command, odom',
        '[omni_kinematics] WARN: active, but nobody publishes cmd_vel yet',
    ]
    environment[FORMAT] = 'of somebody'
    tell = teller()
    tell('[why] INFO: active: why')
    assert environment == {FORMAT: 'of somebody'}
    assert capsys.readouterr().out == '[why] INFO: active: why\n'
