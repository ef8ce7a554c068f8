"""`agv topic` says what `ros2 topic` says, on a real graph."""

from __future__ import annotations

import re
import signal

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Float64MultiArray


@pytest.fixture(scope='module')
def talker(alone):
    """Let the command itself say hello 25 times a second, long enough to be found."""
    process = alone.start(
        'topic', 'pub', '-r', '25', '-p', '100000', '/chatter', 'std_msgs/msg/String', 'data: hello'
    )
    alone('topic', 'echo', '/chatter', '--once')
    yield process
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60.0)


def test_list(alone, talker):
    """Four seconds: an announcement that was lost comes again after three."""
    patient = ('topic', 'list', '--spin-time', '4')
    lines = alone(*patient, '-t')[1].splitlines()
    assert '/chatter [std_msgs/msg/String]' in lines
    assert lines == sorted(lines)
    assert ' * /chatter [std_msgs/msg/String] 1 publisher' in alone(*patient, '-v')[1]
    assert {'/parameter_events', '/rosout'} <= set(alone('topic', 'list')[1].split())
    assert int(alone('topic', 'list', '-c')[1]) >= 2


def test_info(alone, talker):
    status, out, _ = alone('topic', 'info', '/chatter', '--spin-time', '4')
    assert (status, out) == (
        0, 'Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 0\n',
    )  # fmt: skip
    assert (
        'Endpoint type: PUBLISHER'
        in alone('topic', 'info', '/chatter', '-v', '--spin-time', '4')[1]
    )


@pytest.mark.parametrize(
    ('options', 'output'),
    [
        ((), 'data: hello\n---\n'),
        (('--csv',), 'hello\n'),
        (('--field', 'data'), 'hello\n---\n'),
        (('-l', '2'), 'data: he...\n---\n'),
        (('--no-str',), "data: '<string length: <5>>'\n---\n"),
        (('--filter', 'm.data == "hello"'), 'data: hello\n---\n'),
    ],
)
def test_echo_once(alone, talker, options, output):
    assert alone('topic', 'echo', '/chatter', '--once', *options)[:2] == (0, output)


def test_echo_goes_on_until_interrupted(alone, talker):
    process = alone.start('topic', 'echo', '/chatter')
    for _ in range(10):
        assert process.stdout.readline() in {'data: hello\n', '---\n'}
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60.0)
    assert process.returncode == 0


def test_what_the_filter_leaves_out_is_not_shown(alone, talker):
    arguments = ('topic', 'echo', '/chatter', '--timeout', '0.5', '--filter', 'm.data == "bye"')
    assert alone(*arguments)[:2] == (0, '')


def test_hz_and_bw(alone, talker):
    _, out, _ = alone('topic', 'hz', '/chatter', '--duration', '2')
    assert 1 <= int(re.findall(r'average rate: (\d+)\.', out)[-1]) <= 50
    assert re.search(r'\tmin: [\d.]+s max: [\d.]+s std dev: [\d.]+s window: \d+', out)
    _, out, _ = alone('topic', 'bw', '/chatter', '--duration', '2')
    assert out.startswith('Subscribed to [/chatter]\n')
    assert re.search(r'[\d.]+ K?B/s from \d+ messages\n\tMessage size mean: ', out)


def test_pub(agv, graph):
    node = graph.node('listener')
    heard = []
    node.create_subscription(TwistStamped, 'cmd_vel', heard.append, 10)
    status, out, _ = agv(
        'topic', 'pub', '--once', '/cmd_vel', 'geometry_msgs/msg/TwistStamped',
        '{header: auto, twist: {linear: {x: 1}}}', cold=True,
    )  # fmt: skip
    assert status == 0
    assert 'publisher: beginning loop\npublishing #1: geometry_msgs.msg.TwistStamped(' in out
    graph.spin_until(lambda: heard)
    assert heard[0].twist.linear.x == 1.0
    assert heard[0].header.stamp.sec > 0


@pytest.mark.parametrize(
    'words',
    [
        ('pub', '--once', '-w', 0, '/x y', 'std_msgs/msg/Bool', '{}'),
        ('pub', '--once', '-w', 0, '', 'std_msgs/msg/Bool', '{}'),
        ('pub', '--once', '-w', 0, '-n', 'a b', '/x', 'std_msgs/msg/Bool', '{}'),
        ('echo', 'x/', 'std_msgs/msg/Bool', '--once', '--timeout', 1),
    ],
)
def test_a_name_that_none_can_be_is_refused_in_a_line(agv, words):
    status, _, errors = agv('topic', *words)
    assert status == 1
    assert re.fullmatch(r"error: .*(must not|'a b').*\n", errors)


def test_pub_some_times_with_arrays(agv, graph):
    """The first may come before the listener has found its sender: two seconds are enough."""
    node = graph.node('listener')
    heard = []
    node.create_subscription(Float64MultiArray, 'array', heard.append, 50)
    status, out, _ = agv(
        'topic', 'pub', '-t', '40', '-r', '20', '/array', 'std_msgs/Float64MultiArray',
        '{layout: {dim: [{label: a, size: 2}]}, data: [1, 2]}',
    )  # fmt: skip
    assert (status, out.count('publishing #')) == (0, 40)
    graph.spin_until(lambda: heard)
    assert list(heard[0].data) == [1.0, 2.0]
    assert heard[0].layout.dim[0].label == 'a'


@pytest.mark.parametrize(
    ('arguments', 'word'),
    [
        (('info', '/chater'), "Unknown topic '/chater'; did you mean '/chatter'?"),
        (('echo', '/chatter', 'std_msgs/msg/Sting'), "did you mean 'String'?"),
        (('echo', '/chatter', '--field', 'date', '--once'), 'it has data'),
        (('echo', '/chatter', '--qos-reliability', 'maybe'), 'choose one of'),
        (('pub', '/chatter', 'std_msgs/msg/String', '{date: 1}'), "did you mean 'data'?"),
        (('pub', '/chatter', 'std_msgs/msg/String', 'hello'), 'dictionary in YAML'),
        (('pub', '/chatter', 'nowhere_msgs/msg/String'), "package 'nowhere_msgs' has no msg"),
    ],
)
def test_mistakes_are_told_in_one_line(alone, talker, arguments, word):
    status, _, errors = alone('topic', *arguments)
    assert status == 1
    assert word in errors
    assert 'Traceback' not in errors


@pytest.mark.parametrize(
    ('number', 'command', 'sign'),
    [
        (signal.SIGTERM, ('hz', '/chatter'), 'average rate'),
        (signal.SIGHUP, ('hz', '/chatter'), 'average rate'),
        (signal.SIGTERM, ('bw', '/chatter'), 'Message size'),
        (signal.SIGTERM, ('echo', '/chatter'), 'data: hello'),
        (signal.SIGTERM, ('pub', '-r', '50', '/other', 'std_msgs/msg/String'), 'publishing #3'),
        (signal.SIGINT, ('pub', '-r', '50', '/other', 'std_msgs/msg/String'), 'publishing #3'),
    ],
)
def test_a_signal_ends_what_has_no_end(alone, talker, number, command, sign):
    process = alone.start('topic', *command)
    while sign not in process.stdout.readline():
        assert process.poll() is None
    process.send_signal(number)
    _, errors = process.communicate(timeout=60.0)
    assert (process.returncode, errors) == (0, '')


def test_an_answer_that_was_not_waited_for_is_no_success(alone, talker):
    process = alone.start('topic', 'list', '--spin-time', '600')
    alone('topic', 'info', '/chatter')  # as long as the other needs to join
    process.send_signal(signal.SIGTERM)
    out, errors = process.communicate(timeout=60.0)
    assert (process.returncode, out) == (130, '')
    assert 'Traceback' not in errors


@pytest.mark.parametrize('expression', ['m.nothing > 1', 'm.data >', '1 / 0'])
def test_a_filter_that_fails_is_told(alone, talker, expression):
    status, _, errors = alone('topic', 'echo', '/chatter', '--filter', expression)
    assert status == 1
    assert errors.startswith(f"error: --filter '{expression}'")
    assert 'Traceback' not in errors


def test_a_topic_that_nobody_has_ends_with_a_warning(alone, talker):
    status, out, errors = alone('topic', 'echo', '/nothing')
    assert status == 1
    assert out == 'WARNING: topic [/nothing] does not appear to be published yet\n'
    assert errors == 'error: Could not determine the type for the passed topic\n'


def test_who_is_there_but_not_heard_makes_a_list_a_failure(alone, talker):
    frozen = alone.start('topic', 'pub', '-r', '50', '/frozen', 'std_msgs/msg/String')
    while 'publishing #1' not in frozen.stdout.readline():
        assert frozen.poll() is None
    frozen.send_signal(signal.SIGSTOP)
    try:
        status, out, errors = alone('topic', 'list')
    finally:
        frozen.send_signal(signal.SIGCONT)
        frozen.send_signal(signal.SIGTERM)
        frozen.communicate(timeout=60.0)
    assert '/chatter' in out
    assert '/frozen' not in out
    assert status == 1
    assert 'warning: 1 of the DDS participants on this machine were not heard' in errors
