"""The events that a recorder has begun and not saved yet: what a killed one leaves to the next.

A hidden file in the folder of events, one line of JSON each, appended and waited for; a kill costs
at most the line that is being written. Whoever writes it holds its lock, so a journal without one
is that of a recorder that is gone.
"""

from __future__ import annotations

import fcntl
import json
import os
import secrets
from contextlib import suppress
from functools import partial
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.bag.events.event import Event, from_entries
from agv_motion.bag.events.event_parameters import LONGEST_BEFORE
from agv_motion.files.unfinished import told

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

ENDING = '.events.jsonl'
_MOST = 1 << 26
"""[bytes] that are read of a journal"""


class LeftBehind(NamedTuple):
    """What a recorder that was killed had not done."""

    recording: str
    """folder of its bag"""
    only_events: bool
    before: float
    """[s] that it kept before an event"""
    events: dict[int, Event]
    """that were not saved, by their numbers in the journal"""


class Journal:
    """Notes events while they are open; gone when it is closed with none left."""

    def __init__(self, path: Path, lock: int) -> None:
        """Take over an open file; see :func:`begin` and :func:`left_behind`."""
        self.path = path
        self._file = lock

    def note(self, number: int, event: Event) -> None:
        """Note an event, or that it goes on; ``number`` is its own in this journal."""
        self._append({'number': number, 'event': event.entries()})

    def saved(self, number: int) -> None:
        """Note that nothing is left to do for an event."""
        self._append({'number': number})

    def close(self, *, done: bool) -> None:
        """Let go of the file; delete it first if there is nothing left to do."""
        if done:
            self.path.unlink(missing_ok=True)
        os.close(self._file)

    def _append(self, entry: dict[str, Any]) -> None:
        line = b'\n' + json.dumps(entry).encode() + b'\n'  # whole, also after half of another
        with told(self.path):
            os.write(self._file, line)
            os.fsync(self._file)


def begin(folder: Path, recording: Path, before: float, *, only_events: bool) -> Journal:
    """Return a new journal of the events of a recording.

    Raises:
        SourceError: The disk takes nothing.

    """
    with told(folder):
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f'.{recording.name}.{secrets.token_hex(4)}{ENDING}'
        file = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_EXCL, 0o666)
    journal = Journal(path, file)
    with suppress(OSError):  # a file system without locks: then it is never taken for left behind
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    journal._append(  # noqa: SLF001 - the head of its own file
        {'recording': str(recording.absolute()), 'only_events': only_events, 'before': before}
    )
    return journal


class OwnJournal:
    """The journal of a recorder, which is not there before it is needed. For any thread."""

    def __init__(self, folder: Path, recording: Path, before: float, *, only_events: bool) -> None:
        """Make nothing yet; arguments as of :func:`begin`."""
        self.folder = folder
        self._begin = partial(begin, folder, recording, before, only_events=only_events)
        self._lock = Lock()
        self._journal: Journal | None = None

    def begin(self) -> Journal:
        """Return the journal; make it if it is not there.

        Raises:
            SourceError: The disk takes nothing.

        """
        with self._lock:
            self._journal = self._journal or self._begin()
            return self._journal

    def note(self, number: int, event: Event) -> None:
        """Note an event, or that it goes on."""
        self.begin().note(number, event)

    def saved(self, number: int) -> None:
        """Note that nothing is left to do for an event."""
        self.begin().saved(number)

    def close(self, *, done: bool) -> None:
        """Let go of the file, if there is one; delete it first if there is nothing left to do."""
        if self._journal is not None:
            self._journal.close(done=done)
            self._journal = None


def left_behind(folder: Path) -> Iterator[tuple[Journal, LeftBehind]]:
    """Yield what killed recorders have left in a folder, each with its journal, locked."""
    for path in sorted(folder.glob(f'.*{ENDING}')) if folder.is_dir() else ():
        try:
            file = os.open(path, os.O_RDWR | os.O_APPEND)
        except OSError:
            continue
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:  # its recorder lives
            os.close(file)
            continue
        yield Journal(path, file), _parsed(os.pread(file, _MOST, 0))


def _parsed(data: bytes) -> LeftBehind:
    """Return what a journal tells; lines that are none, or halves, are passed over."""
    head: dict[str, Any] = {}
    events: dict[int, Event] = {}
    for line in data.splitlines():
        try:
            entry = json.loads(line)
        except (ValueError, RecursionError):
            continue
        if not isinstance(entry, dict):
            continue
        if isinstance(entry.get('recording'), str):
            head = entry
        number, event = entry.get('number'), from_entries(entry.get('event'))
        if isinstance(number, int) and event is not None:
            events[number] = event
        elif isinstance(number, int):
            events.pop(number, None)
    before = head.get('before')
    if not isinstance(before, (int, float)) or not 0 <= before <= LONGEST_BEFORE:
        before = 0.0
    only_events = head.get('only_events') is True
    return LeftBehind(head.get('recording', ''), only_events, float(before), events)
