"""The black box of a recorder: events out of what is being recorded, each a small bag of its own.

The time before an event lies on the disk already, in the files of the recording, so that a kill
takes no more of it than of any recording. When an event is over, the present file is finished and
the wanted time is copied out of the finished ones, by a thread of its own; until then the recording
deletes none that it needs. Events that overlap become one bag with all their moments: a wheel that
slips twenty times in a minute is one story, and its minutes are on the disk once.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import suppress
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.bag.events import journal as journals
from agv_motion.bag.events.event import Event, Moment, new_event
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future

    from agv_motion.bag.events.event_parameters import EventParameters
    from agv_motion.bag.events.journal import Journal, LeftBehind
    from agv_motion.bag.recording.recording import Recording

SECOND = 10**9
KILLED = 'the recorder was killed'
ENDED = 'the recording ended'
_LATE = SECOND // 5
"""[ns] that messages may need from their arrival into the recording"""
_AGAIN = SECOND // 2
"""[ns] after which a moment of an event that goes on is written into the journal again"""


def _nothing(_: str) -> None:
    """Tell nobody."""


@dataclass
class _Open:
    """An event that is not over."""

    number: int
    event: Event
    noted: int
    """[ns] its last moment that is in the journal"""


class BlackBox:
    """Makes bags of events. One thread may use it; it never waits for the disk but to note one."""

    def __init__(
        self, recording: Recording, given: EventParameters,
        tell: Callable[[str], object] = _nothing, complain: Callable[[str], object] = _nothing,
    ) -> None:  # fmt: skip
        """Look for what a killed recorder has left, and begin.

        Args:
            recording: What is being recorded; told which of its files are needed.
            given: What is kept of an event.
            tell: Called with what became of an event, from any thread.
            complain: Called with why an event has no bag, from any thread.

        Raises:
            SourceError: The disk takes nothing.

        """
        self.folder = given.events_folder(recording.path)
        self.saved: list[Path] = []
        """bags that were made"""
        self._recording, self._given = recording, given
        self._tell, self._complain = tell, complain
        self._open: _Open | None = None
        self._count = self._failed = 0
        self._journal: Journal | None = None
        self._waiting: dict[Future[None], Event] = {}
        self._worker = ThreadPoolExecutor(1, 'events')
        for found, left in journals.left_behind(self.folder):
            self._worker.submit(self._finish_left, found, left)
        recording.only_needed = given.only_events
        if given.only_events:
            self._noting()

    @property
    def event(self) -> Event | None:
        """The event that goes on at present."""
        return self._open.event if self._open else None

    def add(self, moment: Moment) -> Event:
        """Take note that something happened; return the event that it belongs to.

        Raises:
            SourceError: The disk takes no note of it: a kill would lose it.

        """
        now = self._open
        if now is not None and not now.event.takes(moment):
            self._end(now)
            now = None
        if now is None:
            self._count += 1
            now = self._open = _Open(self._count, new_event(moment, self._given), -_AGAIN)
        else:
            now.event = now.event.joined(moment, self._given)
        self._needs(moment.stamp)
        if moment.stamp - now.noted >= _AGAIN:
            now.noted = moment.stamp
            self._noting().note(now.number, now.event)
        return now.event

    def update(self, now: int) -> None:
        """End the event whose time is over, or before which the clock was set back.

        Args:
            now: [ns] by the clock of the recording.

        """
        one = self._open
        if one is not None and not one.event.begin <= now <= one.event.end + _LATE:
            self._end(one)
        self._needs(now)

    def finish(self, now: int) -> None:
        """End what is open, cut short, while the recording still goes on; does not wait."""
        one = self._open
        if one is not None:
            if now < one.event.end:
                one.event = replace(one.event, cut_short=ENDED)
            self._end(one)

    def wait(self) -> None:
        """Wait for the bags of all events that are over."""
        wait(self._waiting)

    def close(self) -> None:
        """Wait for all bags, once the recording is closed; then tidy up."""
        self._worker.shutdown()
        if self._journal is not None:
            with suppress(OSError):
                self._journal.close(done=not self._failed)
            self._journal = None
        if self._given.only_events and not self._failed:
            from agv_motion.bag.events.saving import delete_recording  # noqa: PLC0415 - as below

            delete_recording(self._recording.path)

    def _noting(self) -> Journal:
        """Return the journal, which is not there before it is needed."""
        if self._journal is None:
            self._journal = journals.begin(
                self.folder, self._recording.path, self._given.before,
                only_events=self._given.only_events,
            )  # fmt: skip
        return self._journal

    def _needs(self, now: int) -> None:
        """Tell the recording which of its files may still be needed."""
        for done in [future for future in self._waiting if future.done()]:
            del self._waiting[done]
        begins = [event.begin for event in self._waiting.values()]
        begins += [self._open.event.begin] if self._open else []
        if self._given.trigger or self._given.only_events:
            begins.append(now - round(self._given.before * SECOND))
        self._recording.needed_from = min(begins, default=inf)

    def _end(self, one: _Open) -> None:
        """Hand an event to the thread that saves it."""
        self._open = None
        future = self._worker.submit(self._save, one.number, one.event)
        self._waiting[future] = one.event

    def _save(self, number: int, event: Event) -> None:
        """Make the bag of an event."""
        from agv_motion.bag.events.saving import save  # noqa: PLC0415 - edits bags: not needed before

        try:
            self._recording.split()
            files = [
                self._recording.path / file.path
                for file in self._recording.finished_files()
                if file.messages and file.start <= event.end and file.end >= event.begin
            ]
            if files:
                self._made(save(event, files, self._recording.path, self.folder), event)
            else:
                self._complain(f"nothing was recorded around '{event.first.reason}'")
            self._noting().saved(number)
        except (AgvMotionError, OSError) as error:
            self._failed += 1
            self._complain(f"event '{event.first.reason}' is not saved yet: {error}")

    def _made(self, path: Path, event: Event) -> None:
        self.saved.append(path)
        others = len(event.moments) + event.more - 1
        more = f' and {others} more' if others else ''
        short = f', cut short: {event.cut_short}' if event.cut_short else ''
        self._tell(f"event '{event.first.reason}'{more} saved as {path}{short}")

    def _finish_left(self, journal: Journal, left: LeftBehind) -> None:
        """Make the bags that a killed recorder owes, and one of its end where it kept no more."""
        from agv_motion.bag.events import saving  # noqa: PLC0415 - as above

        recording, made = Path(left.recording), 0
        if not recording.is_absolute() or '\0' in left.recording:
            journal.close(done=False)
            self._complain(
                f"the journal {journal.path} is of no recording ('{left.recording}'): its events "
                'cannot be saved; delete it'
            )
            return
        try:
            files = saving.recording_files(recording)
            for number, event in owed(left, saving.last_stamp(files), journal):
                path = saving.save_torn(event, files, self.folder)
                if path is not None:
                    self.saved.append(path)
                    made += 1
                    self._tell(f"event '{event.first.reason}', {KILLED}: saved as {path}")
                journal.saved(number)
        except (AgvMotionError, OSError) as error:
            journal.close(done=False)
            self._complain(f'events of {recording}, {KILLED}: {error}')
            return
        journal.close(done=True)
        if left.only_events and files:
            saving.delete_recording(recording)
        if made < len(left.events):
            lost = len(left.events) - made
            self._complain(f'{lost} events of {recording}: nothing of their time is there')


def owed(left: LeftBehind, end: int, journal: Journal) -> Iterator[tuple[int, Event]]:
    """Yield the events, with their numbers, of a recording that was killed at ``end`` [ns]."""
    known = dict(left.events)
    if left.only_events and end and not any(e.takes(Moment(end, '')) for e in known.values()):
        number = max(known, default=0) + 1
        begin = max(end - round(left.before * SECOND), 0)
        known[number] = Event((Moment(end, KILLED),), begin, end)
        journal.note(number, known[number])
    for number, event in known.items():
        yield number, replace(event, cut_short=KILLED) if event.end > end else event
