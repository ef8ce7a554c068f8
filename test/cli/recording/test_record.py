"""`agv record` as a real process beside the graph of the test."""

from __future__ import annotations

import os
import pty
import signal

import pytest
from rosbags.rosbag2 import Reader

rclpy = pytest.importorskip('rclpy')

from rclpy.duration import Duration
from rclpy.qos import QoSProfile
from std_msgs.msg import Int32


@pytest.fixture
def publisher(graph):
    node = graph.node('talker')
    return node.create_publisher(Int32, 'number', QoSProfile(depth=1000))


def test_until_ctrl_c_and_then_what_was_lost(agv, graph, publisher, tmp_path):
    process = agv.start('record', '/number', '-o', tmp_path / 'bag', '--compression', 'lz4')
    graph.spin_until(publisher.get_subscription_count)
    for i in range(500):
        publisher.publish(Int32(data=i))
        graph.spin_for(0.0005)
    assert publisher.wait_for_all_acked(Duration(seconds=60.0))
    graph.spin_for(0.5)  # acknowledged is not yet recorded
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=60.0)
    assert process.returncode == 0, errors
    line = next(line for line in out.splitlines() if line.startswith('/number'))
    assert line.split()[1] == '500'
    assert line.split()[3:5] == ['0', '0']
    with Reader(tmp_path / 'bag') as reader:
        assert [data[4] for _, _, data in reader.messages()] == [i % 256 for i in range(500)]


def test_the_disk_at_its_floor_is_an_error(agv, publisher, tmp_path):
    status, _, errors = agv('record', '-a', '-o', tmp_path / 'bag', '--keep-free', '1e9')
    assert status == 1
    assert 'error: recording' in errors
    assert 'keep_free' in errors


def test_a_folder_that_exists_is_told(alone, tmp_path):
    status, _, errors = alone('record', '-a', '-o', tmp_path)
    assert status == 1
    assert 'choose a new folder' in errors
    assert 'Traceback' not in errors


@pytest.mark.parametrize('number', [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_and_a_terminal_that_is_gone_leave_a_whole_bag(
    agv, graph, publisher, tmp_path, number
):
    """A terminal that is closed sends SIGHUP, and takes no word any more."""
    master, terminal = pty.openpty()
    process = agv.start(
        'record', '/number', '-o', tmp_path / 'bag', stdin=terminal, stdout=terminal,
        stderr=terminal, start_new_session=True,
    )  # fmt: skip
    os.close(terminal)
    graph.spin_until(publisher.get_subscription_count)
    graph.repeat(
        lambda: publisher.publish(Int32(data=1)),
        lambda: (tmp_path / 'bag' / 'bag_0.mcap').stat().st_size > 2000,
        every=0.01,
    )
    os.close(master)
    process.send_signal(number)
    graph.spin_until(lambda: process.poll() is not None)
    assert process.returncode == 0
    with Reader(tmp_path / 'bag') as reader:
        assert reader.message_count > 0
        assert len(list(reader.messages())) == reader.message_count


def test_nothing_to_record_says_what_to_name(alone):
    status, _, errors = alone('record', '-o', '/proc/none')
    assert status == 1
    assert errors == (
        'error: nothing to record: name topics, or give -a for all, or --regex for those that '
        'match\n'
    )
