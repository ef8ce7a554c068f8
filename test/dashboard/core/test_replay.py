"""A bag, looked back into: the same board as live, at any moment of it."""

from __future__ import annotations

import json
from functools import partial

import pytest

from agv_motion.bag import BagWriter, OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.dashboard.core.replay import Replay
from agv_motion.errors import SourceError

SECOND = 1_000_000_000
BEGIN = 1_700_000_000


def text(word):
    data = word.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


class Recording:
    """A bag of a robot that says each second what time it is."""

    def __init__(self, folder):
        self.folder = folder
        self.bag = BagWriter(folder)
        latched = (OfferedQos(durability='transient_local'),)
        self.state = self.bag.add_topic(
            '/oak/state', 'std_msgs/msg/String', 'string data', qos=latched
        )
        self.odom = self.bag.add_topic('/oak/odom', 'std_msgs/msg/String', 'string data')

    def say(self, second, word):
        self.bag.write(self.state, (BEGIN + second) * SECOND, text(word))
        self.bag.flush()


@pytest.fixture
def recording(tmp_path):
    found = Recording(tmp_path / 'bag')
    found.say(0, 'starting')
    found.say(300, 'walking')
    found.say(310, 'resting')
    return found


def state(replay):
    replay.board.refresh(replay.at)
    cell = replay.board.cells.get(('oak', 'state'))
    return None if cell is None else json.loads(cell.update)['value']['text']


@pytest.mark.parametrize(
    ('second', 'word'),
    [(0.5, 'starting'), (299.0, 'starting'), (305.0, 'walking'), (400.0, 'resting')],
)
def test_at_a_moment_is_known_what_was_known_then(recording, second, word):
    recording.bag.close()
    replay = Replay(partial(BagReader, recording.folder), BEGIN + second)
    assert state(replay) == word
    assert replay.board.cells['oak', 'state'].at <= BEGIN + second
    replay.close()


def test_from_there_on_time_passes(recording):
    recording.bag.close()
    replay = Replay(partial(BagReader, recording.folder), BEGIN + 301.0)
    assert state(replay) == 'walking'
    replay.advance(BEGIN + 309.9)
    assert state(replay) == 'walking'
    replay.advance(BEGIN + 310.1)
    assert state(replay) == 'resting'
    replay.close()


def test_a_bag_that_is_still_written_goes_on(recording):
    replay = Replay(partial(BagReader, recording.folder), BEGIN + 311.0)
    assert state(replay) == 'resting'
    recording.say(320, 'walking again')
    replay.advance(BEGIN + 321.0)
    assert state(replay) == 'walking again'
    recording.bag.close()
    replay.close()


def test_a_topic_of_another_type_is_not_shown(recording):
    recording.bag.write(recording.odom, (BEGIN + 1) * SECOND, text('no odometry'))
    recording.bag.close()
    replay = Replay(partial(BagReader, recording.folder), BEGIN + 2.0)
    assert 'odom' not in replay.board.robots['oak'].latest
    replay.close()


def test_where_there_is_no_bag_that_is_told(tmp_path):
    with pytest.raises(SourceError, match='does not exist'):
        Replay(partial(BagReader, tmp_path / 'no'), 0.0)
