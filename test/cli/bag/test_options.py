"""One door to bags for every command that reads one: what is lost is told, and costs the status."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState
from typer.testing import CliRunner

from agv_motion.bag.metadata import Topic
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.cli.main import app
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

READERS = (
    ('bag', 'info', '{bag}'),
    ('bag', 'echo', '{bag}', '/fix'),
    ('bag', 'hz', '{bag}'),
    ('bag', 'hz', '{bag}', '--header'),
    ('bag', 'gaps', '{bag}', '/fix'),
    ('bag', 'check', '{bag}'),
    ('bag', 'plot', '{bag}', '/fix/pose/pose/position', '-o', '{out}/a.png'),
    ('bag', 'export', '{bag}', '{out}/tables'),
    ('bag', 'diff', '{bag}', '{bag}'),
    ('plot', '{bag}', '-o', '{out}/run.png'),
    ('calibrate', '{bag}', '-o', '{out}/new.yaml'),
    ('reprocess', '{bag}', '{out}/again', '-n', 'differential_kinematics', '-c', ''),
)
"""Every command that reads a whole bag; `recover` and `replay` are for torn ones."""


def run(command, bag, out):
    """Return status and all that is told; an error that nobody expected fails."""
    words = [word.format(bag=bag, out=out) for word in command]
    result = CliRunner().invoke(app, words)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, ' '.join(result.output.split())


@pytest.fixture(scope='module')
def driven(tmp_path_factory):
    """Return the bag of a straight drive of 20 s."""
    path = tmp_path_factory.mktemp('driven') / 'bag'
    with BagWriter(path, chunk_size=4000) as writer:
        wheels = writer.add_topic('/wheels/state', 'sensor_msgs/msg/JointState')
        fixes = writer.add_topic('/fix', 'geometry_msgs/msg/PoseWithCovarianceStamped')
        for i in range(201):
            time = 100 * 10**9 + i * 10**8
            state = JointState(name=['left_wheel', 'right_wheel'], position=[0.3 * i, 0.3 * i])
            state.velocity = [3.0, 3.0]
            state.header.stamp = stamp_of(time)
            fix = PoseWithCovarianceStamped()
            fix.header.stamp = state.header.stamp
            fix.pose.pose.position.x = 0.015 * i
            fix.pose.pose.orientation.w = 1.0
            fix.pose.covariance[0] = fix.pose.covariance[7] = fix.pose.covariance[35] = 1e-4
            writer.write(wheels, time, codec(JointState).encode(state))
            writer.write(fixes, time, codec(PoseWithCovarianceStamped).encode(fix))
    return path


@pytest.mark.parametrize('command', READERS, ids=lambda command: ' '.join(command[:2]))
def test_status_0_and_no_word_of_a_whole_bag(driven, tmp_path, command):
    status, told = run(command, driven, tmp_path)
    assert status == 0, told
    assert 'byte' not in told


@pytest.mark.parametrize('command', READERS, ids=lambda command: ' '.join(command[:2]))
@pytest.mark.parametrize('share', [0.3, 0.6])
def test_where_a_bag_is_torn_is_told_and_costs_the_status(driven, tmp_path, command, share):
    (file,) = driven.glob('*.mcap')
    data = file.read_bytes()
    torn = tmp_path / 'torn.mcap'
    torn.write_bytes(data[: round(len(data) * share)])
    with BagReader(torn) as bag:
        (problem,) = (' '.join(str(problem).split()) for problem in bag.problems)
    for _ in range(2 if command[0] == 'reprocess' else 1):  # nor does a rerun forget it
        status, told = run(command, torn, tmp_path)
        assert status == 1, told
        assert problem.replace(' ', '') in told.replace(' ', '')
        assert (command[0] != 'plot') or '/fix: ' in told
    for made in ('run.png', 'new.yaml', 'again'):
        assert (tmp_path / made).exists() == any(made in word for word in command)


def test_one_topic_without_a_time_ends_no_list_of_rates(tmp_path):
    """It is skipped by name; alone it is an error."""
    header = 'std_msgs/Header header\nfloat64 x\n' + '=' * 80 + '\nMSG: std_msgs/Header\n'
    good = f'{header}builtin_interfaces/Time stamp\nstring frame_id\n'
    bad = f'{header}float64 stamp\nstring frame_id\n'
    with BagWriter(tmp_path / 'bag') as writer:
        for i, (name, text) in enumerate({'/a': bad, '/b': good, '/c': good}.items()):
            topic = writer.add_topic(name, f't/msg/T{i}', text, type_hash='')
            for k in range(20):
                data = k.to_bytes(4, 'little') + bytes(4) + b'\1\0\0\0\0' + bytes(3)
                writer.write(topic, k * 10**9, b'\0\1\0\0' + data + bytes(8))
        odd = Topic('/odd', 'Odd', 'std_msgs/Header header', '', (), 'ros2msg', 'json')
        writer.write(writer.add(odd), 0, b'{}')
    for verb in ('hz', 'gaps'):
        status, told = run(('bag', verb, '{bag}', '--header'), tmp_path / 'bag', tmp_path)
        assert status == 1
        assert '/a is skipped: ' in told
        assert '/odd is skipped: ' in told
        assert ('/b 1.000' if verb == 'hz' else 'No gaps') in told, told
        status, told = run(('bag', verb, '{bag}', '/b', '--header'), tmp_path / 'bag', tmp_path)
        assert (status, 'skipped' in told) == (0, False)
