"""Playing real bags in real time, into a list."""

from __future__ import annotations

import time

import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.playback.playback import Playback
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError

TEXT = 'std_msgs/msg/String'
DEFINITION, _ = get_typestore(Stores.ROS2_JAZZY).generate_msgdef(TEXT, ros_version=2)
SECOND = 1_000_000_000
START = 1000 * SECOND
STEP = SECOND // 20


@pytest.fixture
def bag(tmp_path):
    """Return a bag of a second: 20 messages on /a, and /map latched at 0 s and 0.5 s."""
    latched = [OfferedQos(durability='transient_local', depth=1)]
    with BagWriter(tmp_path / 'bag') as writer:
        first = writer.add_topic('/a', TEXT, DEFINITION)
        second = writer.add_topic('/map', TEXT, DEFINITION, qos=latched)
        for i in range(20):
            if i in {0, 10}:
                writer.write(second, START + i * STEP, b'm%02d' % i)
            writer.write(first, START + i * STEP, b'%02d' % i)
    with BagReader(tmp_path / 'bag') as reader:
        yield reader


class Player:
    """A playback, and what it sent with the time of sending."""

    def __init__(self, bag, wait_until, **given):
        self.sent, self.times = [], []
        self.wait_until = wait_until
        self.playback = Playback(bag, PlaybackParameters(**given), self.take)
        self.begun = time.perf_counter()
        self.playback.start()

    def take(self, message):
        self.times.append(time.perf_counter() - self.begun)
        self.sent.append(message.data.decode())

    def to_the_end(self):
        assert self.playback.finished.wait(60.0)
        assert not self.playback.failure
        return self.sent

    def until(self, count):
        self.wait_until(lambda: len(self.sent) >= count)

    def sends_nothing(self, seconds):
        """Return whether nothing comes for a while."""
        count = len(self.sent)
        assert not self.playback.finished.wait(seconds)
        return len(self.sent) == count


@pytest.fixture
def play(bag, wait_until):
    players = []

    def start(**given):
        players.append(Player(bag, wait_until, **given))
        return players[-1]

    yield start
    for player in players:
        player.playback.stop()


def numbers(sent):
    return [int(text) for text in sent if not text.startswith('m')]


def test_every_message_at_its_time(play):
    player = play(topics=('/a',))
    assert numbers(player.to_the_end()) == list(range(20))
    delays = [t - i * 0.05 for i, t in enumerate(player.times)]
    assert min(delays) >= 0.0
    assert sorted(delays)[10] < 0.2  # a busy machine wakes late
    assert player.playback.lag.count == 20


def test_twice_as_fast_takes_half_the_time(play):
    player = play(rate=10.0)
    player.to_the_end()
    assert 0.095 <= player.times[-1] < 0.9


@pytest.mark.parametrize(
    ('given', 'expected'),
    [
        ({'start_offset': 0.5}, range(10, 20)),
        ({'playback_duration': 0.2}, range(5)),
        ({'start_offset': 0.3, 'playback_duration': 0.1}, range(6, 9)),
        ({'playback_until': 1000.1}, range(3)),
        ({'exclude_topics': ('/map',), 'start_offset': 0.9}, range(18, 20)),
        ({'regex': '^/a', 'start_offset': 0.9}, range(18, 20)),
        ({'exclude_regex': 'map', 'playback_duration': 0.0}, range(1)),
    ],
)
def test_parts_of_a_bag(play, given, expected):
    assert numbers(play(rate=100.0, **given).to_the_end()) == list(expected)


def test_its_place_is_within_what_is_played(play):
    player = play(start_offset=0.25, playback_duration=0.5, start_paused=True)
    assert player.playback.position() == START + SECOND // 4
    player.playback.resume()
    player.to_the_end()
    assert player.playback.position() == START + 3 * SECOND // 4


def test_what_was_latched_before_the_start_comes_first(play):
    assert play(rate=100.0, start_offset=0.9).to_the_end() == ['m10', '18', '19']
    assert play(rate=100.0, start_offset=0.25).to_the_end()[:2] == ['m00', '05']


def test_loop_begins_again_with_what_is_latched(play):
    player = play(rate=100.0, start_offset=0.9, loop=True)
    player.until(9)
    player.playback.stop()
    assert player.sent[:9] == ['m10', '18', '19'] * 3


def test_paused_it_waits_and_goes_message_by_message(play):
    player = play(start_paused=True, topics=('/a',))
    assert player.sends_nothing(0.1)
    assert player.sent == []
    player.playback.play_next()
    player.until(1)
    player.playback.play_next(3)
    player.until(4)
    assert player.sends_nothing(0.05)
    assert player.sent == ['00', '01', '02', '03']
    player.playback.set_rate(100.0)
    player.playback.resume()
    assert numbers(player.to_the_end()) == list(range(20))
    with pytest.raises(ConfigurationError, match='at the end'):
        player.playback.play_next()


def test_pause_holds_the_time_of_the_bag(play):
    player = play()
    player.until(3)
    player.playback.pause()
    position, count = player.playback.position(), len(player.sent)
    player.playback.finished.wait(0.2)
    assert player.playback.position() == position
    assert len(player.sent) <= count + 1


def test_seek_forward_and_back(play):
    player = play(start_paused=True)
    player.playback.seek(START + 18 * STEP)
    player.until(1)
    assert player.sent == ['m10']
    player.playback.play_next()
    player.until(2)
    player.playback.seek(START)
    player.playback.set_rate(100.0)
    player.playback.resume()
    assert player.to_the_end()[:4] == ['m10', '18', 'm00', '00']
    assert numbers(player.sent)[1:] == list(range(20))


def test_seek_after_the_end_plays_on_from_there(play):
    player = play(rate=100.0, start_offset=0.9)
    player.to_the_end()
    player.sent.clear()
    player.playback.seek(START + 18 * STEP)
    assert player.to_the_end() == ['m10', '18', '19']
    player.playback.pause()
    player.sent.clear()
    player.playback.seek(START + 19 * STEP)
    player.until(1)
    player.playback.play_next()
    assert player.to_the_end() == ['m10', '19']


def test_after_a_failure_there_is_nowhere_to_seek(bag):
    playback = Playback(bag, PlaybackParameters(), lambda message: message.nothing)
    playback.start()
    assert playback.finished.wait(60.0)
    with pytest.raises(ConfigurationError, match='ended'):
        playback.seek(START)


@pytest.mark.parametrize('late', [0, 1, 123_456_789, 999_999_999])
def test_the_message_at_the_very_end_is_played(tmp_path, wait_until, late):
    """In nanoseconds exactly, in seconds as near as a number of seconds tells."""
    today = 1_434_366_000 * SECOND + late
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', TEXT, DEFINITION)
        for i, stamp in enumerate((today - SECOND, today - 1, today, today + 1, today + SECOND)):
            writer.write(topic, stamp, b'%d' % i)
    with BagReader(tmp_path / 'bag') as bag:
        exact = Player(bag, wait_until, playback_until_nsec=today, rate=1000.0)
        assert exact.to_the_end() == ['0', '1', '2']
        near = Player(bag, wait_until, playback_until=today / 1e9, rate=1000.0)
        assert near.to_the_end()[:3] == ['0', '1', '2']
        short = Player(bag, wait_until, playback_duration=1.0, rate=1000.0)
        assert short.to_the_end() == ['0', '1', '2']
        for player in (exact, near, short):
            player.playback.stop()


def test_what_an_override_latches_is_told_from_before_the_start(bag, wait_until):
    offers = {'/a': OfferedQos(durability='transient_local', depth=2), '/map': OfferedQos()}
    sent = []
    playback = Playback(
        bag, PlaybackParameters(start_offset=0.9, rate=100.0), lambda m: sent.append(m.data), offers
    )
    playback.start()
    assert playback.finished.wait(60.0)
    playback.stop()
    assert sent == [b'16', b'17', b'18', b'19']


def test_a_time_outside_is_refused(play):
    player = play(start_paused=True, start_offset=0.5)
    with pytest.raises(ConfigurationError, match=r'0\.100 s: choose a time in \[0\.500, 0\.950\]'):
        player.playback.seek(START + 2 * STEP)


def test_the_rate_may_change_meanwhile_within_its_range(play):
    player = play(rate=1.0)
    player.until(2)
    with pytest.raises(ConfigurationError, match='rate = 0'):
        player.playback.set_rate(0.0)
    player.playback.set_rate(50.0)
    player.to_the_end()
    assert player.times[-1] < 0.9


def test_delay_waits_before_the_first(play):
    player = play(delay=0.2, rate=100.0)
    player.to_the_end()
    assert player.times[0] >= 0.2


@pytest.mark.parametrize(
    ('given', 'message'),
    [
        ({'topics': ('/ab',)}, "did you mean '/a'"),
        ({'exclude_regex': '.'}, 'no topic'),
        ({'start_offset': 5.0}, 'nothing to play'),
        ({'playback_until': 1.0}, 'nothing to play'),
    ],
)
def test_nothing_to_play_is_refused(bag, given, message):
    with pytest.raises(ConfigurationError, match=message):
        Playback(bag, PlaybackParameters(**given), print)


def test_a_send_that_fails_ends_it_with_the_reason(bag):
    def fail(_):
        msg = 'no network'
        raise RuntimeError(msg)

    playback = Playback(bag, PlaybackParameters(), fail)
    playback.start()
    assert playback.finished.wait(60.0)
    assert 'no network' in playback.failure
