"""The journal of a recorder: what is owed, after halves of lines and among the living."""

from __future__ import annotations

from pathlib import Path

import pytest

from agv_motion.bag.events.event import Event, Moment
from agv_motion.bag.events.journal import OwnJournal, begin, left_behind

ONE, TWO = (Event((Moment(stamp, 'slip'),), 0, stamp) for stamp in (5, 9))


def owed(folder):
    """Return what is left behind, and let go of it again."""
    found = []
    for journal, left in left_behind(folder):
        found.append(left)
        journal.close(done=False)
    return found


def test_what_was_noted_and_not_saved_is_owed(tmp_path):
    journal = begin(tmp_path, Path('/bags/walk'), 30.0, only_events=True)
    journal.note(1, ONE)
    journal.note(2, ONE)
    journal.note(2, TWO)
    journal.saved(1)
    assert owed(tmp_path) == []  # its recorder lives
    journal.close(done=False)
    (left,) = owed(tmp_path)
    assert (left.recording, left.only_events, left.before) == ('/bags/walk', True, 30.0)
    assert left.events == {2: TWO}


def test_nothing_stays_of_one_with_nothing_left_to_do(tmp_path):
    begin(tmp_path, Path('walk'), 30.0, only_events=False).close(done=True)
    assert list(tmp_path.iterdir()) == []
    assert owed(tmp_path / 'gone') == []


def test_half_a_line_is_passed_over_and_written_after(tmp_path):
    journal = begin(tmp_path, Path('/bags/walk'), 30.0, only_events=False)
    journal.note(1, ONE)
    with journal.path.open('ab') as file:
        file.write(b'{"number": 1, "ev')
    journal.note(2, TWO)
    journal.close(done=False)
    assert owed(tmp_path)[0].events == {1: ONE, 2: TWO}


def test_a_journal_of_nonsense_owes_nothing(tmp_path):
    (tmp_path / '.x.events.jsonl').write_bytes(b'[1]\n{"number": {}}\n\xff\n{"before": "x"}\n')
    (left,) = owed(tmp_path)
    assert (left.recording, left.only_events, left.before, left.events) == ('', False, 0.0, {})


@pytest.mark.parametrize('before', [0, 0.5, 86400])
def test_the_time_before_an_event_is_kept_as_it_was(tmp_path, before):
    (tmp_path / '.x.events.jsonl').write_text(f'{{"recording": "/bags/walk", "before": {before}}}')
    assert owed(tmp_path)[0][:3] == ('/bags/walk', False, before)


@pytest.mark.parametrize('before', ['Infinity', 'NaN', '1e999', '1' + '0' * 400, '86401', '-1'])
def test_a_time_that_no_recorder_keeps_is_none(tmp_path, before):
    head = f'{{"recording": "/bags/walk", "only_events": true, "before": {before}}}'
    (tmp_path / '.x.events.jsonl').write_text(head)
    assert owed(tmp_path)[0][:3] == ('/bags/walk', True, 0.0)


def test_journals_of_the_same_recording_are_others(tmp_path):
    two = [begin(tmp_path, Path('walk'), 1.0, only_events=False) for _ in range(2)]
    assert two[0].path != two[1].path
    assert all(j.path.name.startswith('.walk.') for j in two)
    for journal in two:
        journal.close(done=True)


def test_the_journal_of_a_recorder_is_not_there_before_it_is_needed(tmp_path):
    own = OwnJournal(tmp_path / 'events', tmp_path / 'walk', 5.0, only_events=False)
    own.close(done=True)
    assert not own.folder.exists()
    own.note(1, TWO)
    own.note(2, TWO)
    own.saved(1)
    (path,) = own.folder.iterdir()
    own.close(done=False)
    ((journal, left),) = left_behind(own.folder)
    assert journal.path == path
    assert left.events == {2: TWO}
    journal.close(done=True)
    assert not list(own.folder.iterdir())
