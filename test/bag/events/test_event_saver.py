"""What a killed recorder owes; the bags themselves are judged in test_black_box.py."""

from __future__ import annotations

from agv_motion.bag.events.event import Event, Moment
from agv_motion.bag.events.event_saver import KILLED, EventSaver, Told, owed
from agv_motion.bag.events.journal import LeftBehind, OwnJournal, begin, left_behind

SECOND = 10**9
OVER = Event((Moment(50 * SECOND, 'slip'),), 40 * SECOND, 55 * SECOND)
OPEN = Event((Moment(58 * SECOND, 'stop'),), 48 * SECOND, 63 * SECOND)


def owing(tmp_path, end, events, *, only_events):
    journal = OwnJournal(tmp_path, tmp_path / 'walk', 10.0, only_events=only_events)
    left = LeftBehind(str(tmp_path / 'walk'), only_events, 10.0, events)
    found = list(owed(left, end, journal.begin()))
    journal.close(done=False)
    return found


def test_events_that_go_on_when_the_recorder_is_killed_are_cut_short(tmp_path):
    found = dict(owing(tmp_path, 60 * SECOND, {1: OVER, 2: OPEN}, only_events=False))
    assert found[1] == OVER
    assert found[2].cut_short == KILLED
    assert found[2].moments == OPEN.moments


def test_the_end_of_a_recorder_that_keeps_events_alone_is_an_event(tmp_path):
    (one, other) = owing(tmp_path, 60 * SECOND, {1: OVER}, only_events=True)
    assert one == (1, OVER)
    assert other == (2, Event((Moment(60 * SECOND, KILLED),), 50 * SECOND, 60 * SECOND))
    ((journal, left),) = left_behind(tmp_path)  # noted, before any bag is made
    assert left.events == {2: other[1]}
    journal.close(done=True)
    assert len(owing(tmp_path, 60 * SECOND, {2: OPEN}, only_events=True)) == 1  # it is in that
    assert owing(tmp_path, 0, {}, only_events=True) == []  # nothing was recorded


def test_an_event_of_a_recording_of_ten_seconds_begins_at_zero_at_the_earliest(tmp_path):
    (one,) = owing(tmp_path, 4 * SECOND, {}, only_events=True)
    assert one == (1, Event((Moment(4 * SECOND, KILLED),), 0, 4 * SECOND))
    whole = Event((Moment(5, 'slip'),), 0, 60 * SECOND)
    assert owing(tmp_path, 60 * SECOND, {7: whole}, only_events=False) == [(7, whole)]


def test_events_of_which_nothing_is_there_are_told_by_their_number(tmp_path):
    events, complaints, told = tmp_path / 'events', [], []
    journal = begin(events, tmp_path / 'walk', 10.0, only_events=False)
    for number in (1, 2, 3):
        journal.note(number, OVER)
    journal.close(done=False)
    own = OwnJournal(events, tmp_path / 'next', 10.0, only_events=False)
    saver = EventSaver(None, own, Told(told.append, complaints.append))
    saver.close()
    where = tmp_path / 'walk'
    assert complaints == [f'3 events of {where}: nothing of their time is there']
    assert (told, saver.saved, saver.failed, list(events.iterdir())) == ([], [], False, [])
