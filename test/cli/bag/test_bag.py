"""`agv bag` on a bag of several topics, as a person types it."""

from __future__ import annotations

import csv
import math
import os
import pty
import re
from contextlib import suppress

import numpy as np
import pytest
import yaml
from rosbags.typesys import Stores, get_typestore
from typer.testing import CliRunner

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.cli.bag.group import app
from agv_motion.errors import ConfigurationError

STORE = get_typestore(Stores.ROS2_JAZZY)
TWIST, JOINTS = 'geometry_msgs/msg/TwistStamped', 'sensor_msgs/msg/JointState'
TENTH = 100_000_000
BEGIN = 1_400_000_000 * 10**9


def messages(i):
    make = STORE.types
    time = make['builtin_interfaces/msg/Time'](*divmod(BEGIN + i * TENTH, 10**9))
    header = make['std_msgs/msg/Header'](time, 'base_link')
    vector = make['geometry_msgs/msg/Vector3']
    twist = make['geometry_msgs/msg/Twist'](
        vector(math.sin(i / 9), 0.0, 0.0), vector(0.0, 0.0, 0.5)
    )
    values = np.arange(3.0) + i
    yield '/cmd_vel', TWIST, make[TWIST](header, twist)
    yield '/joints', JOINTS, make[JOINTS](header, ['a', 'b', 'c'], values, -values, np.zeros(0))


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp('inspect') / 'walk'
    with BagWriter(path) as writer:
        topics = {}
        for i in (i for i in range(100) if not 40 <= i < 60):
            for name, kind, message in messages(i):
                if name not in topics:
                    text = STORE.generate_msgdef(kind, ros_version=2)[0]
                    topics[name] = writer.add_topic(name, kind, text, type_hash='')
                data = bytes(STORE.serialize_cdr(message, kind))
                writer.write(topics[name], BEGIN + i * TENTH, data, BEGIN + i * TENTH - 5, i + 1)
    return path


def run(*arguments, status=0):
    result = CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=False)
    assert result.exit_code == status, result.output
    return result.output


def test_info_as_ros2_bag_info_says_it(bag):
    out = run('info', bag)
    assert 'Files:             walk_0.mcap' in out
    assert 'Duration:          9.900000000s' in out
    assert 'Start:             May 13 2014 16:53:20.000000000 UTC (1400000000.000000000)' in out
    assert 'Messages:          160' in out
    row = (
        'Topic: /joints | Type: sensor_msgs/msg/JointState | Count: 80 | Serialization Format: cdr'
    )
    assert row in out
    assert run('info', bag, '-t').split() == ['/cmd_vel', '/joints']


def test_info_tells_each_type_of_a_topic_that_changed_it(tmp_path):
    with BagWriter(tmp_path / 'changed') as writer:
        for kind, field, count in (('a/msg/B', 'int8 x', 2), ('a/msg/A', 'int8 y', 5)):
            topic = writer.add_topic('/a', kind, field, type_hash='')
            for stamp in range(count):
                writer.write(topic, BEGIN + stamp, b'\0\1\0\0\1')
    rows = re.findall(
        r'Topic: (\S+) \| Type: (\S+) \| Count: (\d+)', run('info', tmp_path / 'changed')
    )
    assert rows == [('/a', 'a/msg/A', '5'), ('/a', 'a/msg/B', '2')]


def test_echo_as_yaml(bag):
    documents = list(yaml.safe_load_all(run('echo', bag, '/joints')))
    assert len(documents) == 81
    assert documents[2]['position'] == [2.0, 3.0, 4.0]
    assert documents[2]['name'] == ['a', 'b', 'c']
    assert documents[2]['header']['frame_id'] == 'base_link'


def test_echo_of_a_field_filtered_from_an_offset_on(bag):
    out = run(
        'echo', bag, '/cmd_vel', '--field', 'twist.linear', '--csv', '--start-offset', '7',
        '--playback-duration', '0.5', '--filter', 'm.x > 0.99',
    )  # fmt: skip
    expected = [math.sin(i / 9) for i in range(70, 75) if math.sin(i / 9) > 0.99]
    assert [float(row.split(',')[0]) for row in out.split()] == expected
    assert len(expected) in range(1, 5)


def test_echo_once_without_arrays_and_with_numbers(bag):
    out = run('echo', bag, '/joints', '--once', '--no-arr', '-i')
    info, message, _ = yaml.safe_load_all(out)
    assert info == {
        'source_timestamp': BEGIN - 5,
        'received_timestamp': BEGIN,
        'publication_sequence_number': 1,
    }
    assert message['position'] == '<sequence type: double, length: 3>'


def test_rates_and_gaps(bag):
    row = next(line for line in run('hz', bag).splitlines() if line.startswith('/cmd_vel'))
    assert row.split() == ['/cmd_vel', '7.980', '0.100s', '2.100s', '0.22359s', '80']
    (row,) = [line for line in run('gaps', bag, '--header').splitlines() if '/joints' in line]
    assert row.split() == ['/joints', '3.900s', '2.100s', '0.100s', '20']
    assert run('gaps', bag, '--longer', '3') == 'No gaps\n'


def test_check_tells_by_its_exit_status(bag):
    assert '0 errors and 2 warnings in 160 messages of 2 topics' in run('check', bag)
    run('check', bag, '--strict', status=1)
    out = run('check', bag, '--rate', '/joints=20', status=1)
    assert 'error: /joints: 7.980 Hz, expected 20 Hz within 10%' in out
    with pytest.raises(ConfigurationError, match='/odom=50'):
        run('check', bag, '--rate', '/joints')


def test_each_finding_has_a_line_of_its_own_in_a_terminal(bag, alone):
    master, slave = pty.openpty()
    status, *_ = alone(
        'bag', 'check', bag, stdin=slave, stdout=slave, stderr=slave,
        env=os.environ | {'TERM': 'xterm-256color'},
    )  # fmt: skip
    os.close(slave)
    shown = b''
    with suppress(OSError):  # the end of a terminal is an error
        while some := os.read(master, 65536):
            shown += some
    os.close(master)
    assert status == 0
    assert b'Looking' in shown
    before = re.findall(rb'([^\n]*)warning: ', shown)
    assert len(before) == 2
    assert all(line.endswith(b'\x1b[2K') or not line for line in before), before


def test_recover(bag, tmp_path):
    cut = tmp_path / 'cut.mcap'
    cut.write_bytes((bag / 'walk_0.mcap').read_bytes()[:5000])
    out = run('recover', cut, tmp_path / 'saved', status=1)
    assert 'byte' in out
    with BagReader(tmp_path / 'saved') as saved:
        assert f'Saved {saved.message_count} messages' in out
        assert 0 < saved.message_count <= 160
        assert not saved.problems


def test_export_as_csv(bag, tmp_path):
    assert 'cmd_vel.csv: 80 rows' in run('export', bag, tmp_path / 'tables')
    with (tmp_path / 'tables' / 'joints.csv').open() as file:
        rows = list(csv.DictReader(file))
    assert int(rows[2]['log_time']) == BEGIN + 2 * TENTH
    assert [float(rows[2][f'position[{i}]']) for i in range(3)] == [2.0, 3.0, 4.0]
    assert [rows[2]['name[1]'], rows[2]['header.frame_id']] == ['b', 'base_link']
    before = (tmp_path / 'tables' / 'joints.csv').read_bytes()
    assert 'joints.csv: 80 rows, there already' in run('export', bag, tmp_path / 'tables')
    (tmp_path / 'tables' / 'cmd_vel.csv').unlink()
    with pytest.raises(ConfigurationError, match=r'joints\.csv exists, with other content'):
        run('export', bag, tmp_path / 'tables', '--start-offset', '2')
    assert not (tmp_path / 'tables' / 'cmd_vel.csv').exists()
    assert [(p.name, p.read_bytes()) for p in (tmp_path / 'tables').iterdir()] == [
        ('joints.csv', before)
    ]


def test_export_as_parquet(bag, tmp_path):
    parquet = pytest.importorskip('pyarrow.parquet')
    arguments = ('--topics', '/cmd_vel', '--field', 'twist.linear', '-f', 'parquet')
    run('export', bag, tmp_path, *arguments, '--start-offset', '9')
    table = parquet.read_table(tmp_path / 'cmd_vel.parquet')
    assert table.column_names == ['log_time', *(f'twist.linear.{axis}' for axis in 'xyz')]
    assert table['twist.linear.x'].to_pylist() == [math.sin(i / 9) for i in range(90, 100)]


def test_plot(bag, tmp_path):
    picture = tmp_path / 'walk.png'
    run(
        'plot',
        bag,
        '/cmd_vel/twist/linear/x,/cmd_vel/twist/angular/z',
        '/joints/position',
        '-o',
        picture,
    )
    assert picture.read_bytes().startswith(b'\x89PNG')
    with pytest.raises(ConfigurationError, match='no topic of bag'):
        run('plot', bag, '/odom/pose')
    with pytest.raises(ConfigurationError, match='be exact'):
        run('plot', bag, '/joints/name')
