"""The time of a recording: that of /clock where it tells another one than the arrivals."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from rosgraph_msgs.msg import Clock

from agv_motion.bag.editing.diff import Tolerance, diff
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError
from agv_motion.reprocess import Plan, reprocess
from agv_motion.reprocess.bag_clock import BagClock
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
NOON = 1434366000 * SECOND
PLAN = Plan('tree.yaml', ('wheel_kinematics',), (('/pose', '/fix'),), 'zstd')


def bag_of(path, *messages):
    """Write messages of `/clock` (stamp, time) and of `/other` (stamp, None)."""
    clocks = codec(Clock)
    with BagWriter(path) as writer:
        topics = {n: writer.add_topic(n, 'rosgraph_msgs/msg/Clock') for n in ('/clock', '/other')}
        for stamp, time in messages:
            tick = clocks.encode(Clock(clock=stamp_of(time or 0)))
            writer.write(topics['/other' if time is None else '/clock'], stamp, tick)
    return path


def told(path):
    with BagReader(path) as bag:
        clock = BagClock(bag)
        return clock, [clock.time_of(message) for message in bag.messages()]


def test_messages_between_two_ticks_have_the_time_of_the_first(tmp_path):
    path = bag_of(tmp_path / 'b', (1, 5 * SECOND), (2, None), (3, 6 * SECOND), (4, None))
    clock, times = told(path)
    assert times == [5 * SECOND, 5 * SECOND, 6 * SECOND, 6 * SECOND]
    assert (clock.topics, clock.start, clock.end()) == ({'/clock'}, 5 * SECOND, 6 * SECOND)


def test_a_recording_that_was_stamped_by_the_clock_has_finer_times(tmp_path):
    """Ticks and stamps differ by less than a tenth of a second."""
    begin = 100 * SECOND
    path = bag_of(tmp_path / 'b', (begin, begin - 9), (begin + 7, None))
    clock, times = told(path)
    assert times == [begin, begin + 7]
    assert (clock.topics, clock.start, clock.end()) == (set(), begin, begin + 7)


def test_a_clock_that_is_no_time_is_told(tmp_path):
    with BagWriter(tmp_path / 'b') as writer:
        topic = writer.add_topic('/clock', 'rosgraph_msgs/msg/Clock')
        writer.write(topic, 7, b'\0\1\0\0')
    with pytest.raises(SourceError, match='the message at 7 ns is no time'):
        told(tmp_path / 'b')


def test_the_time_is_that_of_the_clock_in_the_bag(recorded, copied, tmp_path):
    """Beside a simulation ten times as fast as the clock on the wall."""
    clocks = codec(Clock)

    def hurried(message):
        wall = NOON + (message.stamp - NOON) // 10
        tick = clocks.encode(Clock(clock=stamp_of(message.stamp)))
        if message.connection.topic != '/clock':
            yield '/clock', wall, tick, 'rosgraph_msgs/msg/Clock'
            yield message.connection.topic, wall, message.data, message.connection.type

    copied(recorded / 'c', tmp_path / 'hurried', hurried)
    assert not reprocess(recorded / 'c', tmp_path / 'one', PLAN).simulated
    outcome = reprocess(tmp_path / 'hurried', tmp_path / 'two', PLAN)
    assert not outcome.failure
    assert outcome.simulated
    with BagReader(tmp_path / 'one') as one, BagReader(tmp_path / 'two') as two:
        assert one.counts['/odom'] > 100
        for topic in diff(one, two, ['/odom', '/turrets/command'], Tolerance()):
            assert topic.same, topic
        assert abs(one.end - two.end) < SECOND


def test_a_clock_that_goes_back_is_told(tmp_path):
    clocks = codec(Clock)
    with BagWriter(tmp_path / 'in') as writer:
        topic = writer.add_topic('/clock', 'rosgraph_msgs/msg/Clock')
        for i, second in enumerate((5, 6, 2)):
            writer.write(topic, i, clocks.encode(Clock(clock=stamp_of(second * SECOND))))
    outcome = reprocess(tmp_path / 'in', tmp_path / 'out', PLAN)
    assert '/clock goes back from 6000000000 to 2000000000 ns' in outcome.failure
    assert not (tmp_path / 'out').exists()
