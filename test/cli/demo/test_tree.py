"""`agv demo`: a short walk, its bag and its figure; on recorded probes too."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

WORDS = 'distance', 'inside the zone', '100.0 %', 'probe to turrets', 'p99'
"""of what is told of every walk"""


def test_ctrl_c_in_a_terminal_of_any_size_ends_the_walk_with_its_results(terminal, tmp_path):
    screen = terminal('demo', '--time-factor', 20, '--no-page', '--output', tmp_path)
    for columns, rows in ((80, 24), (200, 50)):
        screen.resize(columns, rows)
        picture = '\n'.join(screen.picture())
        for word in ('pace', 'places', 'wheel2', 'pose', 'state', 'walking'):
            assert word in picture
    screen.wait(lambda text: 'walking to' in text)
    screen.press(b'\x03')
    status, out = screen.end()
    assert status == 0, out
    for word in (*WORDS, 'Bag: '):
        assert word in out
    assert set(screen.frames()) == {(80, 24), (200, 50)}
    assert (tmp_path / 'walk.png').stat().st_size > 10_000
    (mcap,) = (tmp_path / 'bag').glob('*.mcap')
    with mcap.open('rb') as file:
        summary = make_reader(file, validate_crcs=True).get_summary()
    assert summary.statistics.message_count > 200
    with AnyReader([tmp_path / 'bag']) as reader:
        topics = {connection.topic for connection in reader.connections}
        assert {'/turrets/command', '/cmd_vel', '/granier/sap_flow', '/odom'} <= topics


def test_a_walk_on_the_spruce_ends_when_its_time_is_over(alone, tmp_path, springs):
    status, out, errors = alone(
        'demo', '--minutes', 0.1, '--no-page', '--output', tmp_path,
        '--probes', springs, '--days', 2,
    )  # fmt: skip
    assert status == 0, errors
    for word in (*WORDS, 'delta_v_mv', 'top wheel speed'):
        assert word in out
    with AnyReader([tmp_path / 'bag']) as reader:
        assert reader.duration == pytest.approx(6e9, rel=0.2)


def test_a_start_outside_the_recording_is_refused(alone, tmp_path):
    path = tmp_path / 'probes.csv'
    path.write_text('time,probe\n2013-06-10,0.5\n2013-06-11,0.5\n')
    asked = '--no-page', '--output', tmp_path / 'walk', '--start', '2014-06-10'
    status, _, errors = alone('demo', '--probes', path, *asked)
    assert status == 1
    assert 'ends at 2013-06-11T00:00:00+00:00 (line 3), before the start' in errors.replace(
        '\n', ''
    )
    status, _, errors = alone('demo', *asked)
    assert status == 1
    assert 'give its file by --probes' in errors
    assert not (tmp_path / 'walk').exists()


def test_a_recording_without_probes_is_refused(alone, tmp_path):
    path = tmp_path / 'weather.csv'
    path.write_text('time,rain\n0,1\n')
    status, _, errors = alone('demo', '--probes', path, '--no-page', '--output', tmp_path)
    assert status == 1
    assert 'has the columns time, rain: name those of the probes by --columns' in errors
