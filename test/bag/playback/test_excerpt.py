"""What of a bag is played."""

from __future__ import annotations

import pytest

from agv_motion.bag.cdr.definitions import installed
from agv_motion.bag.playback.excerpt import PlaybackExcerpt
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError

SECOND = 10**9


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """Return a bag of 10 s: a message a second on /a, and /map latched at 0 s and 5 s."""
    path = tmp_path_factory.mktemp('excerpt') / 'bag'
    text = 'std_msgs/msg/String'
    with BagWriter(path) as writer:
        a = writer.add_topic('/a', text, installed(text).text)
        latched = [OfferedQos(durability='transient_local', depth=1)]
        chart = writer.add_topic('/map', text, installed(text).text, qos=latched)
        for i in range(11):
            if i % 5 == 0 and i < 10:
                writer.write(chart, i * SECOND, b'm%d' % i)
            writer.write(a, i * SECOND, b'%d' % i)
    with BagReader(path) as reader:
        yield reader


def test_the_span_is_counted_from_the_start_of_the_bag(bag):
    excerpt = PlaybackExcerpt(bag, PlaybackParameters(start_offset=2.0, playback_duration=3.0))
    assert (excerpt.begin, excerpt.end) == (2 * SECOND, 5 * SECOND)
    assert [m.data for m in excerpt.messages(4 * SECOND)] == [b'4', b'm5', b'5']


def test_what_was_latched_before_is_told_but_not_at_the_very_start(bag):
    excerpt = PlaybackExcerpt(bag, PlaybackParameters())
    assert [m.data for m in excerpt.latched_before(7 * SECOND)] == [b'm5']
    assert [m.data for m in excerpt.latched_before(bag.start)] == []


def test_topics_that_are_taken_out_are_not_latched_either(bag):
    excerpt = PlaybackExcerpt(bag, PlaybackParameters())
    excerpt.topics = ['/a']
    assert list(excerpt.latched_before(7 * SECOND)) == []
    assert {m.connection.topic for m in excerpt.messages(0)} == {'/a'}


def test_times_outside_are_refused_and_both_ends_are_inside(bag):
    excerpt = PlaybackExcerpt(bag, PlaybackParameters(start_offset=2.0, playback_duration=3.0))
    excerpt.require_inside(2 * SECOND)
    excerpt.require_inside(5 * SECOND)
    with pytest.raises(ConfigurationError, match=r'1\.000 s: choose a time in \[2\.000, 5\.000\]'):
        excerpt.require_inside(SECOND)
