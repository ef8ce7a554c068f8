"""`agv sequence`, as a person types it: predicted, and performed on the graph."""

from __future__ import annotations

import signal

import pytest

pytest.importorskip('rclpy')

from agv_motion.arbitration import TwistSource
from agv_motion.cli.robot.sequence_keys import keys
from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import start
from agv_motion.sequence.sequence_file import ACTIONS

LONG = 'actions: [{go_to: {x: 50, y: 0, heading: 0}}]'


def test_a_dry_run_tells_every_action_draws_it_and_warns(alone, tmp_path):
    file, picture = tmp_path / 'm.yaml', tmp_path / 'sequence.png'
    file.write_text(f'name: far\ndefaults: {{on_failure: retry 2 then skip}}\n{LONG}')
    status, out, errors = alone('sequence', file, '--dry-run', '--plot', picture)
    assert status == 0, errors
    words = ' '.join(out.split())
    assert 'retry 2 then skip' in words
    assert 'far: 126.3 s, 50.00 m' in words
    assert 'takes 126.3 s, but its timeout is 60 s' in words
    assert picture.read_bytes().startswith(b'\x89PNG')


def test_a_configuration_of_the_package_is_found_by_its_name(alone):
    """As by `agv route` and `agv drive`, wherever one stands."""
    words = 'sequence', 'sequence_example.yaml', '--dry-run', '--config'
    status, out, errors = alone(*words, 'differential.yaml')
    assert (status, errors) == (0, '')
    assert 'go_to' in out
    status, _, errors = alone(*words, 'diferential.yaml')
    assert status == 1
    assert "no file 'diferential.yaml', neither by that path nor in" in errors


def test_every_key_of_every_action_is_explained():
    rows = list(keys())
    assert {row.action for row in rows} >= set(ACTIONS)
    assert all(row.meaning for row in rows)
    assert rows[0] == ('go_to', 'x', 'required', '-100000 to 100000', 'where to go [m]')


def test_an_unknown_action_is_told_with_its_line(alone, tmp_path):
    file = tmp_path / 'm.yaml'
    file.write_text('actions:\n  - wait: 1\n  - goto: {x: 1}\n')
    status, _, errors = alone('sequence', file)
    assert status == 1
    assert "m.yaml, line 3, column 5: unknown action 'goto', did you mean 'go_to'?" in errors


def test_it_drives_a_robot_on_the_graph(agv, real_time_robot, tmp_path):
    file = tmp_path / 'm.yaml'
    file.write_text('actions:\n  - go_to: {x: 0.3, y: 0.1, heading: 30, speed: 1}\n  - wait: 0.1\n')
    robot = real_time_robot()
    process = agv.start('sequence', file)
    robot.find()
    agv.graph.spin_until(lambda: process.poll() is not None)
    out, errors = process.communicate()
    assert process.returncode == 0, errors
    assert '1 of 2: go_to x 0.3' in out
    assert out.splitlines()[-1] == 'done'
    assert robot.pose[:2] == pytest.approx((0.3, 0.1), abs=0.03)
    assert not any(robot.commands[-1])


def test_where_there_is_an_arbiter_it_drives_as_the_source_sequence(agv, real_time_robot, tmp_path):
    file = tmp_path / 'm.yaml'
    file.write_text('actions:\n  - go_to: {x: 0.2, y: 0, heading: 0, speed: 1}\n')
    robot = real_time_robot()
    arbiter = agv.graph.add(LiveNode(ArbiterNode, context=agv.graph.context))
    start(arbiter)
    process = agv.start('sequence', file)
    robot.find()
    drives = TwistSource.SEQUENCE
    agv.graph.spin_until(lambda: arbiter.plain.diagnose().values['driver'] == drives.value)
    agv.graph.spin_until(lambda: process.poll() is not None)
    out, errors = process.communicate()
    assert process.returncode == 0, errors
    assert out.splitlines()[-1] == 'done'
    assert robot.pose[:2] == pytest.approx((0.2, 0.0), abs=0.03)


def test_interrupted_it_brakes_and_fails(agv, real_time_robot, tmp_path):
    file = tmp_path / 'm.yaml'
    file.write_text(LONG)
    robot = real_time_robot()
    process = agv.start('sequence', file)
    robot.find()
    robot.moves()
    process.send_signal(signal.SIGINT)
    agv.graph.spin_until(lambda: process.poll() is not None)
    out, _ = process.communicate()
    assert process.returncode == 1
    assert 'aborted' in out
    assert not any(robot.commands[-1])
