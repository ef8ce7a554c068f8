"""The thread of a recorder that makes the bags of its events, and of those that others owe."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.events import journal as journals
from agv_motion.bag.events.event import Event, Moment
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Future

    from agv_motion.bag.events.journal import Journal, LeftBehind, OwnJournal
    from agv_motion.bag.recording.recording import Recording

SECOND = 10**9
KILLED = 'the recorder was killed'


class Told(NamedTuple):
    """Who is told of events, from any thread."""

    tell: Callable[[str], object]
    """what became of one"""
    complain: Callable[[str], object]
    """why one has no bag"""


class EventSaver:
    """Copies the time of events out of the files of a recording, one after another."""

    def __init__(self, recording: Recording, journal: OwnJournal, told: Told) -> None:
        """Begin with what killed recorders have left in the folder of the events.

        Args:
            recording: Out of which bags are made.
            journal: Of its events.
            told: Who is told of them.

        """
        self.saved: list[Path] = []
        """bags that were made"""
        self.failed = False
        """whether some event has no bag yet"""
        self._recording, self._journal, self._told = recording, journal, told
        self._waiting: dict[Future[None], Event] = {}
        self._worker = ThreadPoolExecutor(1, 'events')
        for found, left in journals.left_behind(journal.folder):
            self._worker.submit(self._finish_left, found, left)

    def save(self, number: int, event: Event) -> None:
        """Let the bag of an event be made; ``number`` is its own in the journal."""
        self._waiting[self._worker.submit(self._save, number, event)] = event

    def begins(self) -> list[int]:
        """Return since when the recording is needed by each event that waits [ns]."""
        for done in [future for future in self._waiting if future.done()]:
            del self._waiting[done]
        return [event.begin for event in self._waiting.values()]

    def wait(self) -> None:
        """Wait for all bags of this recording."""
        wait(self._waiting)

    def close(self) -> None:
        """Wait for all bags, and take no more events."""
        self._worker.shutdown()

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
                self._made(save(event, files, self._recording.path, self._journal.folder), event)
            else:
                self._told.complain(f"nothing was recorded around '{event.first.reason}'")
            self._journal.saved(number)
        except (AgvMotionError, OSError) as error:
            self.failed = True
            self._told.complain(f"event '{event.first.reason}' is not saved yet: {error}")

    def _made(self, path: Path, event: Event) -> None:
        self.saved.append(path)
        others = len(event.moments) + event.more - 1
        more = f' and {others} more' if others else ''
        short = f', cut short: {event.cut_short}' if event.cut_short else ''
        self._told.tell(f"event '{event.first.reason}'{more} saved as {path}{short}")

    def _finish_left(self, journal: Journal, left: LeftBehind) -> None:
        """Make the bags that a killed recorder owes, and one of its end where it kept no more."""
        from agv_motion.bag.events import saving  # noqa: PLC0415 - as above

        recording, made = Path(left.recording), 0
        if not recording.is_absolute() or '\0' in left.recording:
            journal.close(done=False)
            self._told.complain(
                f"the journal {journal.path} is of no recording ('{left.recording}'): its events "
                'cannot be saved; delete it'
            )
            return
        try:
            files = saving.recording_files(recording)
            for number, event in owed(left, saving.last_stamp(files), journal):
                path = saving.save_torn(event, files, self._journal.folder)
                if path is not None:
                    self.saved.append(path)
                    made += 1
                    self._told.tell(f"event '{event.first.reason}', {KILLED}: saved as {path}")
                journal.saved(number)
        except (AgvMotionError, OSError) as error:
            journal.close(done=False)
            self._told.complain(f'events of {recording}, {KILLED}: {error}')
            return
        journal.close(done=True)
        if left.only_events and files:
            saving.delete_recording(recording)
        if made < len(left.events):
            lost = len(left.events) - made
            self._told.complain(f'{lost} events of {recording}: nothing of their time is there')


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
