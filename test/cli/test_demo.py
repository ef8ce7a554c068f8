"""`agv demo`: a short walk, its bag and its figure; on recorded probes too."""

from __future__ import annotations

import signal
import time

import pytest

pytest.importorskip('rclpy')

from mcap.reader import make_reader
from rosbags.highlevel import AnyReader


def test_a_short_walk_leaves_a_bag_and_a_figure(alone, tmp_path):
    status, out, errors = alone('demo', '--minutes', 3, '--output', tmp_path, timeout=60.0)
    assert status == 0, errors
    for word in ('distance', 'inside the zone', '100.0 %', 'probe to turrets', 'p99'):
        assert word in out
    assert (tmp_path / 'walk.png').stat().st_size > 10_000
    (mcap,) = (tmp_path / 'bag').glob('*.mcap')
    with mcap.open('rb') as file:
        summary = make_reader(file, validate_crcs=True).get_summary()
    assert summary.statistics.message_count > 5000
    with AnyReader([tmp_path / 'bag']) as reader:
        topics = {connection.topic for connection in reader.connections}
        assert {'/turrets/command', '/cmd_vel', '/granier/sap_flow', '/odom'} <= topics
        assert reader.duration == pytest.approx(180e9, rel=0.1)


def test_a_walk_on_the_spruce(alone, tmp_path, spruce):
    status, out, errors = alone(
        'demo', '--minutes', 3, '--output', tmp_path, '--probes', spruce, '--days', 2, timeout=60.0
    )
    assert status == 0, errors
    assert 'delta_v_mv' in out
    assert 'top wheel speed' in out


def test_a_recording_without_probes_is_refused(alone, tmp_path):
    path = tmp_path / 'weather.csv'
    path.write_text('time,rain\n0,1\n')
    status, _, errors = alone('demo', '--probes', path, '--output', tmp_path)
    assert status == 1
    assert 'has the columns time, rain: name those of the probes by --columns' in errors


def test_ctrl_c_ends_the_walk_with_its_results(alone, tmp_path):
    process = alone.start('demo', '--output', tmp_path)
    time.sleep(6.0)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=30.0)
    assert process.returncode == 0, errors
    assert 'distance' in out
