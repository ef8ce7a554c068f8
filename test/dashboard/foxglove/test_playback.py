"""A bag as one client plays it: at its time, from anywhere, with what was known before, no loss."""

from __future__ import annotations

import math

import pytest

from agv_motion.bag import BagReader
from agv_motion.dashboard.foxglove import playback
from agv_motion.dashboard.foxglove.playback import BagViewing
from agv_motion.dashboard.foxglove.protocol import PlaybackStatus
from agv_motion.dashboard.foxglove.requests import ProtocolError

SECOND = 1_000_000_000
BOTH = '/count', '/description'


@pytest.fixture
def player(counted):
    made = BagViewing(BagReader(counted))
    yield made
    made.close()


def words(due):
    return [data[8:-1].decode() for _, _, data in due]


def test_messages_come_at_their_time_and_rate(player):
    player.choose(BOTH, 0.0)
    assert player.status(0.0) is PlaybackStatus.PAUSED
    assert words(player.due(50.0)) == ['urdf']
    player.play(100.0)
    assert player.status(100.0) is PlaybackStatus.PLAYING
    assert words(player.due(100.35)) == ['1', '2', '3']
    player.set_rate(2.0, 100.35)
    assert words(player.due(100.46)) == ['4', '5']
    player.pause(100.46)
    assert player.due(200.0) == []
    assert abs(player.position(200.0) - player.begin - 570_000_000) < 1000
    player.play(300.0)
    assert words(player.due(400.0))[-1] == '100'
    assert player.status(400.0) is PlaybackStatus.ENDED
    assert player.position(400.0) == player.end


def test_after_a_leap_what_was_said_last_comes_first_at_the_time_of_the_leap(player):
    player.choose(BOTH, 0.0)
    player.due(0.0)
    place = player.begin + 5 * SECOND + 50_000_000
    player.seek(place, 0.0)
    due = player.due(0.0)
    assert words(due) == ['urdf', '50']
    assert {stamp for _, stamp, _ in due} == {place}
    player.play(0.0)
    assert words(player.due(0.1)) == ['51']
    player.seek(player.begin, 1.0)
    assert words(player.due(1.15)) == ['urdf', '1']
    player.seek(10 * player.end, 2.0)
    assert words(player.due(2.0)) == ['urdf', '99', '100']


def test_who_chooses_more_gets_what_that_had_said_last(player):
    player.play(0.0)
    player.choose(['/count'], 0.0)
    assert words(player.due(0.25)) == ['1', '2']
    player.choose(BOTH, 0.25)
    assert words(player.due(0.35)) == ['urdf', '3']
    player.choose([], 0.35)
    assert player.due(9.0) == []


def test_the_bag_waits_for_who_is_slow(player, monkeypatch):
    monkeypatch.setattr(playback, 'MOST_AT_ONCE', 10)
    player.choose(['/count'], 0.0)
    player.play(0.0)
    found = []
    for now in (100.0, 200.0, 300.0):
        found += words(player.due(now))
    player.hold(500.0)
    assert player.position(500.0) == player.begin + 31 * SECOND // 10
    for now in range(600, 1600, 100):
        found += words(player.due(float(now)))
    assert found == [str(n) for n in range(1, 101)]


@pytest.mark.parametrize('rate', [0.0, -1.0, math.nan, math.inf, 1e9, 10**400, 'fast', None, True])
def test_rates_that_cannot_be_played_are_refused(player, rate):
    with pytest.raises(ProtocolError, match=r'rate = .*must lie in'):
        player.set_rate(rate, 0.0)
    assert player.rate == 1.0


def test_a_bag_that_is_torn_plays_up_to_where_it_is(counted, tmp_path):
    with BagReader(counted) as bag:
        (file,) = (one.path for one in bag.files)
    torn = tmp_path / 'torn.mcap'
    torn.write_bytes(file.read_bytes()[:-200])
    made = BagViewing(BagReader(torn))
    made.choose(BOTH, 0.0)
    made.play(0.0)
    assert words(made.due(100.0))[:2] == ['urdf', '1']
    assert made.status(100.0) is PlaybackStatus.ENDED
    made.close()
