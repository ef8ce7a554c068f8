"""The black box over real recordings: before and after, overlapping, in a ring, after a kill."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

pytest.importorskip('std_msgs')

from agv_motion.bag.editing.request import EditRequest
from agv_motion.bag.events.black_box import BlackBox
from agv_motion.bag.events.event import Moment, events_of
from agv_motion.bag.events.event_parameters import EventParameters
from agv_motion.bag.events.event_saver import KILLED
from agv_motion.bag.notes import Note, add_note, notes_of
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.bag.recording.recording import Recording
from agv_motion.bag.recording.storage_parameters import StorageParameters

SECOND = 10**9
TEXT = 'std_msgs/msg/String'
START = 1_700_000_000
LATCHED = [OfferedQos(durability='transient_local', depth=1)]


def text(word):
    data = word.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


def at(seconds):
    return START * SECOND + round(seconds * SECOND)


class Run:
    """A recording with a map that was told once, and a word a second."""

    def __init__(self, folder, *, storage=None, **given):
        self.told, self.complaints = [], []
        self.parameters = EventParameters(
            **{'before': 10.0, 'after': 5.0, 'longest_event': 30.0, **given}
        )
        storage = {'keep_free': 0.0, 'sync': False, **(storage or {})}
        self.recording = Recording(folder, StorageParameters(**storage))
        self.map = self.recording.add_topic('/map', TEXT, LATCHED)
        self.word = self.recording.add_topic('/word', TEXT, [OfferedQos()])
        self.box = BlackBox(
            self.recording, self.parameters, self.told.append, self.complaints.append
        )
        self.recording.put(self.map, at(0), text('map'), at(0))

    def live(self, begin, end, marks=()):
        """Let seconds pass, from ``begin`` to before ``end``, with a word each and some marks."""
        reasons = dict(marks)
        for second in range(begin, end):
            self.recording.put(self.word, at(second), text(str(second)), at(second))
            if second in reasons:
                self.box.add(Moment(at(second), reasons[second]))
            if second % 8 == 7:
                self.recording.split()
            self.box.update(at(second))
            self.box.wait()

    def end(self, now):
        self.box.finish(at(now))
        self.recording.close()
        self.box.close()
        return self.box.saved


def words(bag):
    """Return the seconds that are told in a bag, and what stands first."""
    with BagReader(bag) as reader:
        assert [str(problem) for problem in reader.problems] == []
        messages = list(reader.messages())
        first = messages[0].connection.topic, messages[0].stamp, messages[0].publish
        found = [int(m.data[8:-1]) for m in messages if m.connection.topic == '/word']
        return found, first, events_of(reader)


def test_an_event_is_a_bag_of_the_time_before_and_after_it_with_what_was_latched(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 30, [(20, '/state ~ stopped')])
    (bag,) = run.end(30)
    assert bag == tmp_path / 'events' / 'event_2023_11_14-22_13_40Z_state_stopped'
    found, first, (event,) = words(bag)
    assert found == list(range(10, 26))
    assert first == ('/map', at(10), at(0))
    assert event.moments == (Moment(at(20), '/state ~ stopped'),)
    assert (event.begin, event.end, event.cut_short) == (at(10), at(25), '')
    assert notes_of(bag) == [Note(at(20), '/state ~ stopped')]
    assert words(tmp_path / 'bag')[0] == list(range(30))  # the recording itself is as it was
    assert not list(bag.parent.glob('.*'))
    assert run.complaints == []


def test_events_that_overlap_are_one_bag_with_all_moments_and_the_next_is_another(tmp_path):
    run = Run(tmp_path / 'bag', events=str(tmp_path / 'kept'))
    run.live(0, 60, [(20, 'slip'), (24, 'slip'), (27, 'tilt'), (50, 'slip')])
    one, two = run.end(60)
    found, _, (event,) = words(one)
    assert found == list(range(10, 33))
    assert [(m.stamp, m.reason) for m in event.moments] == [
        (at(20), 'slip'), (at(24), 'slip'), (at(27), 'tilt'),
    ]  # fmt: skip
    assert words(two)[0] == list(range(40, 56))
    assert one.parent == two.parent == tmp_path / 'kept'


def test_events_without_end_are_cut_into_bags_that_miss_nothing(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 80, [(second, 'slip') for second in range(20, 70)])
    bags = run.end(80)
    spans = [words(bag)[0] for bag in bags]
    assert spans[0] == list(range(10, 51))  # longest_event after its first moment
    assert {second for span in spans for second in span} == set(range(10, 75))
    assert len(bags) == 2


def test_an_event_at_the_end_of_the_recording_tells_that_it_is_cut_short(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 20, [(18, 'battery low')])
    (bag,) = run.end(19)
    found, _, (event,) = words(bag)
    assert found == list(range(8, 20))
    assert event.cut_short == 'the recording ended'


def test_only_events_keeps_a_ring_that_an_event_holds_and_nothing_at_the_end(tmp_path):
    run = Run(tmp_path / 'bag', only_events=True)
    sizes = []
    for begin in range(0, 80, 8):
        run.live(begin, begin + 8, [(44, 'slip')])
        sizes.append(len(list((tmp_path / 'bag').glob('*.mcap'))))
    assert max(sizes) <= 5
    (bag,) = run.end(80)
    found, first, _ = words(bag)
    assert found == list(range(34, 50))
    assert first[0] == '/map'
    assert not (tmp_path / 'bag').exists()
    assert [path.name for path in tmp_path.iterdir()] == ['events']


def test_files_that_an_open_event_needs_outlive_keep_files(tmp_path):
    given = {'before': 20.0, 'after': 25.0, 'trigger': ('/state ~ x',)}
    run = Run(tmp_path / 'bag', storage={'keep_files': 1}, **given)
    run.live(0, 60, [(30, 'slip')])
    (bag,) = run.end(60)
    assert words(bag)[0] == list(range(10, 56))


def test_what_is_noted_in_the_recording_is_noted_in_its_event(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 20)
    run.recording.split()  # the description of the bag is there
    add_note(tmp_path / 'bag', Note(at(12), 'rain'))
    run.live(20, 30, [(20, 'slip')])
    (bag,) = run.end(30)
    assert notes_of(bag) == [Note(at(12), 'rain'), Note(at(20), 'slip')]


def test_a_clock_that_is_set_back_ends_the_event(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 25, [(20, 'slip')])
    run.box.update(at(-1000))
    assert run.box.event is None
    assert words(run.end(25)[0])[0] == list(range(10, 25))


def test_nothing_recorded_around_an_event_is_told(tmp_path):
    run = Run(tmp_path / 'bag')
    run.box.add(Moment(at(500), 'far'))
    assert run.end(600) == []
    assert run.complaints == ["nothing was recorded around 'far'"]


def test_an_event_that_the_disk_refuses_waits_for_the_next_start(tmp_path, monkeypatch):
    run = Run(tmp_path / 'bag', only_events=True)
    run.live(0, 18, [(15, 'slip')])
    with monkeypatch.context() as patch:

        def full(*_, **__):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        patch.setattr('agv_motion.bag.events.saving.edit', full)
        assert run.end(18) == []
    assert 'No space left' in run.complaints[0]
    assert (tmp_path / 'bag').is_dir()
    assert [p for p in (tmp_path / 'events').iterdir() if p.is_dir()] == []
    later = Run(tmp_path / 'later')
    (bag,) = later.end(0)
    found, first, (event,) = words(bag)
    assert (found, first[0], event.first.reason) == (list(range(5, 18)), '/map', 'slip')
    assert not (tmp_path / 'bag').exists()


VICTIM = f"""
import signal, sys
sys.path[:0] = [{str(Path(__file__).parent)!r}]
from pathlib import Path
from test_black_box import Run
run = Run(Path(sys.argv[1]), only_events=sys.argv[2] == 'only', storage={{'flush_period': 0.05}})
run.live(0, 22, [(20, 'slip')] if sys.argv[3] == 'event' else [])
while run.recording._queue or run.recording._writer._file.chunk_size:
    pass
print('now', flush=True)
signal.pause()
"""


@pytest.mark.parametrize(('only', 'event'), [(True, True), (True, False), (False, True)])
def test_a_killed_recorder_leaves_its_events_to_the_next_one(tmp_path, only, event):
    words_given = ['only' if only else 'all', 'event' if event else 'none']
    with subprocess.Popen(  # noqa: S603 - this Python
        [sys.executable, '-c', VICTIM, tmp_path / 'bag', *words_given], stdout=subprocess.PIPE
    ) as victim:
        assert victim.stdout.readline() == b'now\n'
        victim.send_signal(signal.SIGKILL)
    assert not list(tmp_path.glob('events/event*'))
    later = Run(tmp_path / 'later')
    bags = later.end(0)
    (bag,) = bags
    found, first, (told,) = words(bag)
    assert first[0] == '/map'
    if event:
        assert found == list(range(10, 22))
        assert (told.first.reason, told.cut_short) == ('slip', KILLED)
    else:
        assert found == list(range(11, 22))
        assert told.first == Moment(at(21), KILLED)
    assert (tmp_path / 'bag').exists() is not only
    assert [path.name for path in (tmp_path / 'events').iterdir()] == [bag.name]


def test_a_recorder_that_lives_is_not_robbed(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 22, [(20, 'slip')])
    other = Run(tmp_path / 'other')
    assert other.end(0) == []
    assert len(run.end(22)) == 1


@pytest.mark.parametrize('head', ['', '{"recording": "walk", "only_events": true}',
                                  r'{"recording": "/a\u0000b", "only_events": true}'])  # fmt: skip
def test_a_journal_of_no_recording_is_told_and_costs_nobody_a_file(tmp_path, monkeypatch, head):
    monkeypatch.chdir(tmp_path)
    mine = tmp_path / 'walk' / 'mine.mcap', tmp_path / 'mine.mcap'
    mine[0].parent.mkdir()
    for path in mine:
        path.touch()
    (tmp_path / 'events').mkdir()
    journal = tmp_path / 'events' / '.walk.events.jsonl'
    journal.write_text(head)
    run = Run(tmp_path / 'new')
    run.end(1)
    assert [str(journal) in complaint for complaint in run.complaints] == [True]
    assert all(path.exists() for path in mine)


def test_a_reason_that_is_longer_than_a_note_is_saved(tmp_path):
    run = Run(tmp_path / 'walk')
    run.live(0, 4, [(2, '/word ~ ' + 'x' * 5000)])
    (path,) = run.end(4)
    assert run.complaints == []
    assert [note.text[:8] for note in notes_of(path)] == ['/word ~ ']


def test_an_event_is_a_bag_like_any_other(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 30, [(20, 'slip')])
    (bag,) = run.end(30)
    outcome = EditRequest(begin='5').run(bag, tmp_path / 'part')
    assert not outcome.failure
    with BagReader(tmp_path / 'part') as part:
        assert events_of(part)[0].first.reason == 'slip'


def test_an_event_is_over_when_its_time_is_and_messages_may_no_longer_come(tmp_path):
    """At 20 s: from 10 to 25 s, and a fifth of a second for what is on its way."""
    for now, goes_on in (
        (at(10) - 1, False),
        (at(10), True),
        (at(25.2), True),
        (at(25.2) + 1, False),
    ):
        run = Run(tmp_path / f'{now}')
        run.box.add(Moment(at(20), 'slip'))
        run.box.update(now)
        assert (run.box.event is not None) is goes_on
        run.end(26)


def idle(folder, **given):
    """Return a black box over a recording of nothing, and what its journal is told to note."""
    recording = SimpleNamespace(path=folder / 'bag', split=int, finished_files=list)
    box = BlackBox(recording, EventParameters(**{'before': 10.0, 'after': 5.0, **given}))
    noted = []
    box._journal.note = lambda number, event: noted.append((number, event.first.stamp, event.end))  # noqa: SLF001
    return box, noted


def test_an_event_that_goes_on_is_noted_twice_a_second(tmp_path):
    """Also one at the zero of a simulation; the next event has the next number."""
    box, noted = idle(tmp_path)
    half = SECOND // 2
    for stamp in (0, half - 1, half, 2 * half - 1, 2 * half, 2 * half + 9 * SECOND):
        box.add(Moment(stamp, 'slip'))
    box.close()
    ends = [5 * SECOND, 5 * SECOND + half, 6 * SECOND]
    assert noted == [*((1, 0, end) for end in ends), (2, 10 * SECOND, 15 * SECOND)]


@pytest.mark.parametrize(('given', 'idle_needs'), [
    ({}, float('inf')), ({'trigger': ('/a > 1',)}, 30 * SECOND),
    ({'only_events': True}, 30 * SECOND),
])  # fmt: skip
def test_a_recording_is_told_since_when_it_is_needed(tmp_path, given, idle_needs):
    box, _ = idle(tmp_path, **given)
    box.update(40 * SECOND)
    assert box._recording.needed_from == idle_needs  # noqa: SLF001 - of our own making
    box.add(Moment(38 * SECOND, 'slip'))
    assert box._recording.needed_from == 28 * SECOND  # noqa: SLF001 - as above
    box.close()


@pytest.mark.parametrize(('now', 'cut'), [(25, ''), (24, 'the recording ended')])
def test_an_event_is_cut_short_when_the_recording_ends_before_it(tmp_path, now, cut):
    box, _ = idle(tmp_path)
    box.add(Moment(20 * SECOND, 'slip'))
    handed = []
    box._saver.save = lambda number, event: handed.append((number, event.cut_short))  # noqa: SLF001
    box.finish(now * SECOND)
    box.finish(now * SECOND)
    assert handed == [(1, cut)]
    box.close()


def test_what_became_of_each_event_is_told(tmp_path):
    run = Run(tmp_path / 'bag')
    run.live(0, 44, [(3, 'tilt'), (20, 'slip'), (22, 'slip'), (24, 'slip'), (42, 'stop')])
    one, two, three = run.end(44)
    assert run.told == [
        f"event 'tilt' saved as {one}", f"event 'slip' and 2 more saved as {two}",
        f"event 'stop' saved as {three}, cut short: the recording ended",
    ]  # fmt: skip
    assert run.complaints == []
