"""Several bags as one: order, what overlaps, gaps, and what none of them has."""

from __future__ import annotations

import sys
import threading
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / 'editing'))

import bags

from agv_motion.bag.playback.playback import Playback
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.playback.several_bags import SeveralBags
from agv_motion.errors import ConfigurationError, SourceError

SECOND = 10**9


@pytest.fixture
def several(tmp_path):
    """Return three bags: two that overlap, given last, and one an hour later."""
    bags.write(tmp_path / 'late', start=3700, count=10)
    bags.write(tmp_path / 'one', start=100, count=10, topics=('/a',))
    bags.write(tmp_path / 'two', start=100, count=20, topics=('/b',))
    found = SeveralBags([tmp_path / name for name in ('late', 'two', 'one')])
    yield found
    found.close()


def test_messages_come_in_the_order_of_time(several):
    messages = list(several.messages())
    assert len(messages) == 11 + 11 + 21
    assert [m.stamp for m in messages] == sorted(m.stamp for m in messages)
    assert (several.start, several.end) == (100 * SECOND, 3700 * SECOND + 9 * SECOND // 10)
    only = list(several.messages(['/a'], stop=200 * SECOND))
    assert [m.connection.topic for m in only] == ['/a'] * 10
    assert several.topics.keys() == {'/a', '/b', '/c', '/map'}


def test_a_gap_is_where_none_was_recorded(several):
    assert several.gaps() == [(101 * SECOND + 9 * SECOND // 10, 3700 * SECOND)]


def test_a_long_bag_spans_two_short_ones(tmp_path):
    starts = {'long': (100, 600), 'short': (110, 20), 'last': (130, 20)}
    for name, (start, count) in starts.items():
        bags.write(tmp_path / name, start=start, count=count)
    found = SeveralBags([tmp_path / name for name in starts])
    stamps = [m.stamp for m in found.messages()]
    found.close()
    assert stamps == sorted(stamps)
    assert found.gaps() == []


def test_what_none_has_is_refused(several, tmp_path):
    with pytest.raises(ConfigurationError, match='/gone'):
        several.require(['/gone'])
    with pytest.raises(SourceError, match='does not exist'):
        SeveralBags([tmp_path / 'one', tmp_path / 'nowhere'])
    assert several.problems == []
    assert not several.lossy


def test_a_playback_leaps_over_gaps_if_it_is_told_to(several):
    sent, done = [], threading.Event()
    playback = Playback(several, PlaybackParameters(rate=20.0, skip_gaps=True), sent.append)
    playback.start()
    done = playback.finished.wait(60.0)  # an hour at this rate is three minutes
    playback.stop()
    assert done
    assert len(sent) == 43
    assert playback.failure == ''
