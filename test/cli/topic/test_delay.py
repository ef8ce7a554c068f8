"""The age of messages, as `ros2 topic delay` reckons it."""

from __future__ import annotations

import pytest

from agv_motion.cli.topic.delay import Delays


def test_ages_by_hand():
    delays = Delays(10)
    assert delays.text() == ''
    delays.add(9.0, 10.0)  # the first counts for nothing, as of ros2
    assert delays.text() == ''
    delays.add(10.5, 11.0)
    delays.add(11.0, 12.5)
    assert delays.text() == (
        'average delay: 1.000\n\tmin: 0.500s max: 1.500s std dev: 0.50000s window: 2'
    )
    assert delays.text() == 'no new messages'


@pytest.mark.parametrize('now', [0.0, 5.0])
def test_a_clock_that_begins_again_begins_the_ages_again(now):
    delays = Delays(10)
    delays.add(9.0, 10.0)
    delays.add(10.0, 11.0)
    delays.add(0.0, now)
    assert delays.text() == ''


def test_only_the_window_counts():
    delays = Delays(2)
    for i in range(5):
        delays.add(float(i), i + 1.0 + i)
    assert 'min: 4.000s max: 5.000s' in delays.text()
    assert delays.text() == 'no new messages'


def test_delay_of_a_topic(alone):
    talker = alone.start('topic', 'pub', '-r', '50', '/aged', 'std_msgs/msg/Header', '{stamp: now}')
    try:
        status, _, errors = alone('topic', 'delay', '/aged', '--duration', '1')
    finally:
        talker.terminate()
    assert status == 1
    assert "msg does not have header: of '/aged', Header" in errors
