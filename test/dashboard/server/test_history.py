"""Looking back by the doors: how far it reaches, frames of then, an excerpt as a bag."""

from __future__ import annotations

from pathlib import Path

import pytest

from agv_motion.bag import BagReader, BagWriter, OfferedQos
from agv_motion.bag.notes import Note, add_note
from agv_motion.dashboard.server.bag_fleet import BagFleet
from agv_motion.dashboard.server.history_bag import History

SECOND, BEGIN = 1_000_000_000, 1_700_000_000


def text(word):
    data = word.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


@pytest.fixture
def walk(tmp_path):
    folder = tmp_path / 'walk'
    with BagWriter(folder) as bag:
        latched = (OfferedQos(durability='transient_local'),)
        state = bag.add_topic('/elm/state', 'std_msgs/msg/String', 'string data', qos=latched)
        bag.add_topic('/elm/odom', 'nav_msgs/msg/Odometry', 'string data')
        for second in range(100):
            bag.write(state, (BEGIN + second) * SECOND, text(f'step {second}'))
    return folder


@pytest.fixture
def past(site, walk, tmp_path, open_browser):
    site.history = History(walk, tmp_path / 'bags')
    with open_browser() as browser:
        yield browser


def first_state(live):
    while True:
        told = live.receive_json()
        live.send_json({'ack': told.get('n', 0)})
        for one in told.get('updates', ()):
            if one['topic'] == 'state':
                return told['now'], one['value']['text']


def test_it_is_told_how_far_back_one_can_look(past):
    told = past.get('/history').json()
    assert (told['begin'], told['end']) == (BEGIN, BEGIN + 99)


def test_what_is_noted_in_the_bag_is_a_mark(past, walk):
    add_note(walk, Note((BEGIN + 7) * SECOND, 'rain began'))
    marks = past.get('/history').json()['marks']
    noted = [{key: mark[key] for key in ('at', 'text', 'by')} for mark in marks]
    assert noted == [{'at': BEGIN + 7, 'text': 'rain began', 'by': 'agv bag note'}]


def test_frames_of_then_are_as_those_of_now(past):
    with past.socket(f'/live?at={BEGIN + 50.5}&rate=0') as live:
        hello = live.receive_json()
        assert (hello['kind'], hello['robots'], hello['past']) == ('hello', ['elm'], True)
        assert first_state(live) == (BEGIN + 50.5, 'step 50')


@pytest.mark.parametrize('query', ['at=nan', 'at=x', 'at=1e300', 'at=5&rate=-1', 'at=5&rate=inf'])
def test_a_moment_that_is_none_is_refused(past, query):
    with past.socket(f'/live?{query}') as live:
        assert live.receive()['type'] == 'websocket.close'


def test_the_minutes_around_a_moment_are_saved_as_a_bag(past):
    answer = past.act('/history/save', {'begin': BEGIN + 10, 'end': BEGIN + 20})
    assert answer.status_code == 202
    with BagReader(Path(answer.json()['bag'])) as bag:
        stamps = [message.stamp // SECOND - BEGIN for message in bag.messages()]
    assert stamps == [10, *range(10, 20)]


@pytest.mark.parametrize(
    ('begin', 'end'),
    [(0, 10), (BEGIN, BEGIN), (BEGIN + 5, BEGIN), (BEGIN, BEGIN + 1e6), (0, 1e300)],
)
def test_what_cannot_be_saved_is_refused(past, begin, end):
    answer = past.act('/history/save', {'begin': begin, 'end': end})
    assert answer.status_code == 422


def test_in_a_recording_nothing_can_be_done(site, walk, tmp_path, open_browser):
    site.fleet, site.recorded = BagFleet(walk), True
    site.history = History(walk, tmp_path / 'bags')
    with open_browser() as browser:
        for path in ('/stop', '/robots/elm/stop', '/robots/elm/home', '/mark'):
            assert browser.act(path, {'text': 'x'} if path == '/mark' else {}).status_code == 409
        with browser.look() as live:
            live.receive_json()
            assert first_state(live)[1] == 'step 0'
