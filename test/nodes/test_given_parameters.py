"""Parameters that a node does not have, or not of this type: told with what to write."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.ros.parameters import filled

CONFIG = Path(__file__).parents[2] / 'config' / 'differential.yaml'
IMPOSSIBLE = [
    (['-p', 'track:=1'], 'track = 1: expected a decimal number such as 1.0: write 1.0'),
    (['--params-file', '/no/such.yaml'], '/no/such.yaml'),
    (['--bogus'], '--bogus'),
    (['-p', 'track'], "-p 'track': write -p name:=value"),
    (
        ['-p', 'max_wheel_speed:=0.5', '--params-file', str(CONFIG)],
        f"-p max_wheel_speed:=0.5 counts for nothing: '{CONFIG}' says max_wheel_speed",
    ),
]
STARTS = """
import json, os, sys
from agv_motion.nodes.differential_kinematics import main
for number, words in enumerate(json.loads(sys.argv[1])):
    if not os.fork():
        os.dup2(os.open(f'{number}', os.O_CREAT | os.O_WRONLY), 2)
        sys.argv[1:] = ['--ros-args', *words]
        main()
        sys.exit()
    print(os.waitstatus_to_exitcode(os.wait()[1]))
"""


@pytest.fixture(scope='module')
def starts(tmp_path_factory):
    """Return exit status and errors of each node that cannot start; they import all but once."""
    folder = tmp_path_factory.mktemp('starts')
    given = json.dumps([arguments for arguments, _ in IMPOSSIBLE])
    done = subprocess.run(  # noqa: S603 - our own
        [sys.executable, '-c', STARTS, given], cwd=folder,
        capture_output=True, text=True, check=True, timeout=200.0,
    )  # fmt: skip
    return [(int(status), (folder / str(number)).read_text())
            for number, status in enumerate(done.stdout.split())]  # fmt: skip


@pytest.mark.parametrize('number', range(len(IMPOSSIBLE)))
def test_what_cannot_be_is_one_line_and_status_1(starts, number):
    _, words = IMPOSSIBLE[number]
    status, errors = starts[number]
    assert status == 1
    assert len(errors.splitlines()) == 1
    assert errors.startswith('error: ')
    assert words in errors


@pytest.mark.parametrize(
    ('kind', 'given', 'words'),
    [
        (DifferentialKinematics, {'track': 1}, 'track = 1: .* write 1.0'),
        (DifferentialKinematics, {'track': 'wide'}, "track = 'wide': expected a decimal number"),
        (DifferentialKinematics, {'track': True}, 'track = True: expected a decimal number'),
        (DifferentialKinematics, {'track': [0.4]}, 'track = '),
        (DifferentialKinematics, {'wheel_radii': [1, 2]}, r'write \[1.0, 2.0\]'),
        (DifferentialKinematics, {'wheel_radii': 0.1}, 'wheel_radii = 0.1: expected a list'),
        (DifferentialKinematics, {'stamped': 1}, 'stamped = 1: expected true or false'),
        (DifferentialKinematics, {'base_frame': 12}, 'base_frame = 12: expected a text'),
        (DifferentialKinematics, {'joint_names': [1, 2]}, 'each of it a text'),
        (GranierProbe, {'csv.speed': 1}, 'csv.speed = 1: .* write 1.0'),
    ],
)
def test_a_value_of_another_type_is_refused_with_what_to_write(kind, given, words):
    with pytest.raises(ConfigurationError, match=words):
        filled(kind.takes, given, kind.name)


def test_a_live_node_refuses_it_as_well(tester):
    with pytest.raises(ConfigurationError, match=r'track = 1: .* write 1\.0'):
        tester.start(DifferentialKinematics, activate=False, track=1)
    with pytest.raises(ConfigurationError, match=r'joint_names = .*each of it a text'):
        tester.start(DifferentialKinematics, activate=False, joint_names=[1, 2])
    with pytest.raises(ConfigurationError, match=r'csv\.speed = 1: .* write 1\.0'):
        tester.start(GranierProbe, activate=False, csv__speed=1)


@pytest.mark.parametrize(
    ('kind', 'given', 'meant'),
    [
        (DifferentialKinematics, {'trak': 0.4}, "no parameter 'trak'; did you mean 'track'?"),
        (GranierProbe, {'csv__fiel': 'x'}, "no parameter 'csv.fiel'; did you mean 'csv.file'?"),
        (GranierProbe, {'autostrat': False}, "did you mean 'autostart'?"),
        (GranierProbe, {'zzz': 1}, "no parameter 'zzz'"),
        (
            GhostTrajectory,
            {'follow__leash__ease': 1.0},
            "no parameter 'follow.leash.ease' any more; it is 'follow.pace.ease' now",
        ),
    ],
)
def test_a_misspelt_parameter_is_told(tester, kind, given, meant):
    node = tester.start(kind, activate=False, **given)
    assert meant in node.complaint


def test_what_every_node_has_is_no_complaint(tester):
    given = {'use_sim_time': False, 'autostart': True, 'executor': 'events'}
    assert not tester.start(DifferentialKinematics, activate=False, **given).complaint


@pytest.mark.parametrize(
    ('name', 'value', 'words'),
    [
        ('trak', ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=1.0),
         "no parameter 'trak'; did you mean 'track'?"),
        ('track', ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=1),
         'write 1.0'),
        ('x' * 50_000, ParameterValue(type=ParameterType.PARAMETER_BOOL), 'no parameter'),
    ],
)  # fmt: skip
def test_setting_one_that_cannot_be_is_refused_with_what_to_write(tester, name, value, words):
    tester.start(DifferentialKinematics)
    request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
    (result,) = tester.ask(SetParameters, 'differential_kinematics/set_parameters', request).results
    assert not result.successful
    assert words in result.reason
    assert len(result.reason) < 500
