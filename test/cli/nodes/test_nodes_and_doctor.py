"""`agv nodes`, `agv run` and `agv doctor`."""

from __future__ import annotations

import json
import os
import signal

import pytest

rclpy = pytest.importorskip('rclpy')

from sensor_msgs.msg import JointState

from agv_motion.cli.doctor import how_to_get
from agv_motion.cli.terminal import terminal
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import start


def test_nodes_with_their_states(agv, graph):
    start(graph.add(LiveNode(WheelKinematics, context=graph.context)))
    graph.add(rclpy.create_node('plain', context=graph.context))
    told = agv('nodes', '--spin-time', '5')[1].splitlines()
    assert told == sorted(told)  # one that was killed before may still be announced
    assert {'/plain', '/wheel_kinematics [active]'} <= set(told)


def test_run_lists_and_refuses(alone):
    status, out, _ = alone('run')
    assert status == 0
    assert {'granier_probe', 'motion_generator', 'simulator', 'wheel_kinematics'} <= set(
        out.split()
    )
    status, _, errors = alone('run', 'wheel_cinematics')
    assert status == 1
    assert "did you mean 'wheel_kinematics'?" in errors


@pytest.mark.parametrize(
    ('arguments', 'word'),
    [
        (('-p', 'wheel_radius:=-1.0'), 'wheel_radius'),
        (('-p', 'turret_x:=[1.0]'), '1 values in turret_x, 3 in turret_y'),
        (('-p', 'executor:=magic'), 'choose one of events, single_threaded'),
        (('-p', 'wheel_radius:=1'), 'wheel_radius'),
    ],
)
def test_a_node_that_cannot_start_says_why_and_ends_with_1(alone, arguments, word):
    status, _, errors = alone('run', 'wheel_kinematics', '--ros-args', *arguments)
    assert status == 1
    assert word in errors
    assert 'Traceback' not in errors


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('executor', ['events', 'single_threaded'])
def test_a_stopped_node_says_zero_and_ends_with_0(agv, graph, number, executor):
    node = graph.node('listener')
    commands = []
    node.create_subscription(JointState, 'turrets/command', commands.append, 1)
    process = agv.start('run', 'wheel_kinematics', '--ros-args', '-p', f'executor:={executor}')
    graph.spin_until(lambda: commands)  # the two have found each other
    commands.clear()
    process.send_signal(number)
    graph.spin_until(lambda: process.poll() is not None)
    graph.spin_until(lambda: commands)
    process.communicate()
    assert process.returncode == 0
    assert not any(commands[-1].velocity)


def test_doctor_finds_what_is_there_and_tries_to_talk(alone):
    status, out, _ = alone('doctor', '--json', cold=True)
    findings = {finding['what']: finding for finding in json.loads(out)}
    assert status == 0
    assert findings['rclpy']['state'] not in {'missing', ''}
    assert 'hear each other' in findings['two participants']['state']
    assert 'what to do' in alone('doctor', '--no-talk')[1]


@pytest.mark.parametrize(
    ('command', 'module', 'remedy'),
    [
        (('topic', 'list'), 'rclpy', 'pip install "agv_motion[ros]", or source a ROS 2 Jazzy'),
        (('demo',), 'geometry_msgs', 'pip install "agv_motion[ros]"'),
        (('run', 'wheel_kinematics'), 'sensor_msgs', 'pip install "agv_motion[ros]"'),
    ],
)
def test_a_module_that_is_not_installed_is_told_in_one_line(
    alone, tmp_path, command, module, remedy
):
    (tmp_path / 'sitecustomize.py').write_text(f'import sys; sys.modules[{module!r}] = None')
    path = f'{tmp_path}{os.pathsep}{os.environ.get("PYTHONPATH", "")}'
    process = alone.start(*command, cold=True, env=os.environ | {'PYTHONPATH': path})
    _, errors = process.communicate(timeout=60.0)
    assert process.returncode == 1
    assert errors.startswith(f'error: this needs the module {module}, which is not installed: ')
    assert remedy in errors
    assert errors.count('\n') == 1


def test_square_brackets_are_shown_as_they_are(alone):
    """Units, and the extras of a package: no terminal may take them for markup."""
    assert '[degrees] above 0' in alone('drive', 'arc', '--help')[1]
    assert 'agv_motion[plot]' in ' '.join(how_to_get('matplotlib').split())
    told = terminal()
    with told.capture() as captured:
        told.print('pip install "agv_motion[ros]" [m/s] :sos:')
    assert captured.get() == 'pip install "agv_motion[ros]" [m/s] :sos:\n'


def test_a_parameter_that_cannot_be_is_told_with_its_limits(alone):
    words = 'run', 'wheel_kinematics', '--ros-args', '-p'
    assert alone(*words, 'wheel_radius:=-1.0') == (
        1, '', 'error: wheel_radius = -1.0: must lie in [0.001, 10.0]\n',
    )  # fmt: skip
    status, _, errors = alone(*words, 'wheel_radius:=.nan')
    assert (status, errors) == (1, 'error: wheel_radius = nan: must lie in [0.001, 10.0]\n')


def test_no_time_is_negative(alone):
    assert alone('nodes', '--spin-time', '-1')[0] == 2
