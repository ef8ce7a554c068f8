"""`agv replay` as a real process, in a real terminal."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from contextlib import suppress

import pytest

rclpy = pytest.importorskip('rclpy')

from rcl_interfaces.srv import ListParameters
from rclpy.qos import QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

from agv_motion.bag.writer import BagWriter
from agv_motion.cli.recording.keys import split
from agv_motion.cli.recording.replay import _exact
from agv_motion.errors import ConfigurationError

SECOND = 1_000_000_000


@pytest.fixture
def bag(tmp_path):
    """Return a bag of 1 s with 100 numbers."""
    with BagWriter(tmp_path / 'bag') as writer:
        number = writer.add_topic('/number', 'std_msgs/msg/Int32')
        for i in range(100):
            stamp = 1000 * SECOND + i * SECOND // 100
            writer.write(number, stamp, serialize_message(Int32(data=i)))
    return tmp_path / 'bag'


@pytest.fixture
def inbox(graph):
    """Return the numbers that come on /other."""
    node = graph.node('listener')
    numbers = []
    node.create_subscription(
        Int32, '/other', lambda m: numbers.append(m.data), QoSProfile(depth=1000)
    )
    return numbers


def meet_player(graph):
    """Wait until listener and player know each other.

    Its answer proves that it has found who asks, and the listener was announced before that.
    """
    (node,) = graph.nodes
    client = node.create_client(ListParameters, '/bag_player/list_parameters')
    graph.spin_until(client.service_is_ready)
    answers = []
    graph.repeat(
        lambda: answers.append(client.call_async(ListParameters.Request())),
        lambda: any(answer.done() for answer in answers),
        every=0.5,
    )
    graph.spin_until(lambda: all(s.get_publisher_count() for s in node.subscriptions))


def test_to_the_end_remapped_with_a_report(agv, graph, inbox, bag):
    process = agv.start(
        'replay', bag, '-p', '-r', '2', '-m', '/number:=/other', '--start-offset', '0.5',
        '--wait-for-all-acked', '1000',
    )  # fmt: skip
    (node,) = graph.nodes
    resume = node.create_client(Trigger, '/bag_player/resume')
    meet_player(graph)
    graph.spin_until(resume.service_is_ready)
    resume.call_async(Trigger.Request())
    graph.spin_until(lambda: process.poll() is not None)
    out, errors = process.communicate()
    assert process.returncode == 0, errors
    assert inbox == list(range(50, 100))
    assert '50 messages, late by' in out


def test_errors_are_told_in_a_line(alone, bag):
    status, _, errors = alone('replay', bag.parent / 'nowhere')
    assert status == 1
    assert 'nowhere' in errors
    assert 'Traceback' not in errors


def test_keys_in_a_terminal(graph, inbox, bag):
    main, other = pty.openpty()
    command = ['replay', bag, '-p', '-l', '-m', '/number:=/other']
    process = subprocess.Popen(  # noqa: S603 - our own command
        [sys.executable, '-m', 'agv_motion.cli.main', *map(str, command)],
        stdin=other, stdout=other, stderr=other,
    )  # fmt: skip
    meet_player(graph)
    os.write(main, b'\x1b[C\x1b[C\x1b[C')
    graph.spin_until(lambda: inbox == [0, 1, 2])
    shown = b''
    while b'paused' not in shown:  # it is drawn ten times a second, on a busy machine later
        shown += os.read(main, 100_000)
    os.write(main, b'\x1b[A' * 10 + b' ')
    graph.spin_until(lambda: len(inbox) > 150)
    os.write(main, b'q')
    graph.spin_until(lambda: process.poll() is not None)
    assert inbox[:120] == [*range(100), *range(20)]
    os.close(other)
    with suppress(OSError):  # so it ends: nobody has its other side open
        while some := os.read(main, 100_000):
            shown += some
    assert b'late by' in shown
    assert process.returncode == 0


def test_what_a_terminal_sends_as_keys():
    assert split('a\x1b[A \x1b[D\x1b') == ['a', 'up', ' ', 'left', '\x1b']


@pytest.mark.parametrize(
    ('typed', 'nanoseconds'),
    [
        ('1434366000.123456789', 1434366000123456789),
        ('1434366000', 1434366000000000000),
        ('-1', -1000000000),
    ],
)
def test_seconds_that_are_typed_are_exact(typed, nanoseconds):
    assert _exact(typed) == nanoseconds


@pytest.mark.parametrize('typed', ['nan', 'inf', 'noon', ''])
def test_what_is_no_time_is_refused(typed):
    with pytest.raises(ConfigurationError, match='give seconds since 1970'):
        _exact(typed)
