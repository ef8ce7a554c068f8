"""A signal ends a node quietly, with status 0 and an explicit zero, at whatever time it comes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

rclpy = pytest.importorskip('rclpy')

from sensor_msgs.msg import JointState

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
BEGIN = """
import json, os, signal, sys
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import run
make = LiveNode.__init__
def end():
    for _ in range(2):
        os.kill(os.getpid(), signal.SIGINT)
class Node(DifferentialKinematics):
    pass
for number, phase in enumerate(json.loads(sys.argv[1])):
    if not os.fork():
        os.dup2(os.open(f'{number}', os.O_CREAT | os.O_WRONLY), 2)
        exec(phase)
        run(Node)
        sys.exit()
    print(os.waitstatus_to_exitcode(os.wait()[1]))
"""
PHASES = {
    'before the node': 'LiveNode.__init__ = lambda *a, **k: (end(), make(*a, **k))[1]',
    'after its construction': 'LiveNode.__init__ = lambda *a, **k: (make(*a, **k), end())[0]',
    'while it is configured': """
def configured(self, *given):
    DifferentialKinematics.__init__(self, *given)
    end()
Node.__init__ = configured
""",
    'while it is activated': 'Node.begin = lambda self: end()',
    'while it says its last word': """
Node.begin = lambda self: end()
Node.halt = lambda self: (end(), DifferentialKinematics.halt(self))
""",
}


def ended(process):
    """Return exit status and errors."""
    _, errors = process.communicate(timeout=60.0)
    return process.returncode, errors


@pytest.fixture
def slow_import(tmp_path):
    """Return where an rclpy lies whose import says so, and then takes for ever."""
    package = tmp_path / 'rclpy'
    package.mkdir()
    (package / '__init__.py').write_text(
        "import threading\nprint('importing', flush=True)\n"
        # again and again: a signal that comes as Python begins to wait for ever is heeded never
        'while not threading.Event().wait(0.1):\n    pass\n'
    )
    return tmp_path


@pytest.mark.parametrize(
    ('number', 'command'),
    [
        *((number, ['-m', 'agv_motion.nodes.wheel_kinematics']) for number in SIGNALS),
        (signal.SIGINT, ['-m', 'agv_motion.cli.main', 'run', 'wheel_kinematics']),
        (signal.SIGINT, ['-m', 'agv_motion.cli.main', 'demo']),
    ],
)
def test_during_the_imports(slow_import, command, number):
    root = str(Path(__file__).parents[2])
    process = subprocess.Popen(  # noqa: S603 - our own
        [sys.executable, *command], cwd=slow_import, text=True,
        env=os.environ | {'PYTHONPATH': f'{slow_import}:{root}'},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    assert process.stdout.readline() == 'importing\n'
    process.send_signal(number)
    assert ended(process) == (0, '')


@pytest.fixture(scope='module')
def interrupted(tmp_path_factory):
    """Return status and errors for each phase; all are forked once what they import is there."""
    folder, phases = tmp_path_factory.mktemp('interrupted'), json.dumps([*PHASES.values()])
    done = subprocess.run(  # noqa: S603 - our own
        [sys.executable, '-c', BEGIN, phases], cwd=folder,
        capture_output=True, text=True, check=True, timeout=200.0,
    )  # fmt: skip
    ends = [(int(status), (folder / str(number)).read_text())
            for number, status in enumerate(done.stdout.split())]  # fmt: skip
    return dict(zip(PHASES, ends, strict=True))


@pytest.mark.parametrize('phase', PHASES)
def test_twice_in_each_phase_of_a_start(interrupted, phase):
    assert interrupted[phase] == (0, '')


def test_a_node_whose_terminal_is_closed_says_zero_first(graph):
    node = graph.node('listener')
    commands = []
    node.create_subscription(JointState, 'wheels/command', commands.append, 1)
    process = subprocess.Popen(
        [sys.executable, '-m', 'agv_motion.nodes.differential_kinematics'],
        stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    graph.spin_until(lambda: commands)
    process.send_signal(signal.SIGHUP)
    graph.spin_until(lambda: process.poll() is not None)
    graph.spin_until(lambda: commands)
    assert ended(process)[0] == 0
    assert list(commands[-1].velocity) == [0.0, 0.0]


def test_a_node_begun_by_nohup_outlives_its_terminal():
    code = (
        'import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN)\n'
        'from agv_motion.ros.stop import Stop; stop = Stop()\n'
        'signal.raise_signal(signal.SIGHUP); assert not stop.requested\n'
        'signal.raise_signal(signal.SIGINT); assert stop.requested\n'
    )
    process = subprocess.Popen([sys.executable, '-c', code], text=True, stderr=subprocess.PIPE)  # noqa: S603 - our own
    assert ended(process) == (0, '')
