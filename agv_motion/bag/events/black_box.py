"""The black box of a recorder: events out of what is being recorded, each a small bag of its own.

The time before an event lies on the disk already, in the files of the recording, so that a kill
takes no more of it than of any recording. When an event is over, the present file is finished and
the wanted time is copied out of the finished ones, by a thread of its own; until then the recording
deletes none that it needs. Events that overlap become one bag with all their moments: a wheel that
slips twenty times in a minute is one story, and its minutes are on the disk once.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING

from agv_motion.bag.events.event import Event, Moment, new_event
from agv_motion.bag.events.event_saver import EventSaver, Told
from agv_motion.bag.events.journal import OwnJournal

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from agv_motion.bag.events.event_parameters import EventParameters
    from agv_motion.bag.recording.recording import Recording

SECOND = 10**9
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
        self._recording, self._given = recording, given
        self._open: _Open | None = None
        self._count = 0
        self._journal = OwnJournal(
            given.events_folder(recording.path), recording.path, given.before,
            only_events=given.only_events,
        )  # fmt: skip
        self._saver = EventSaver(recording, self._journal, Told(tell, complain))
        recording.only_needed = given.only_events
        if given.only_events:
            self._journal.begin()

    @property
    def folder(self) -> Path:
        """Where the bags of events go."""
        return self._journal.folder

    @property
    def saved(self) -> list[Path]:
        """Bags that were made."""
        return self._saver.saved

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
            self._journal.note(now.number, now.event)
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
        self._saver.wait()

    def close(self) -> None:
        """Wait for all bags, once the recording is closed; then tidy up."""
        self._saver.close()
        with suppress(OSError):
            self._journal.close(done=not self._saver.failed)
        if self._given.only_events and not self._saver.failed:
            from agv_motion.bag.events.saving import delete_recording  # noqa: PLC0415 - edits bags: not needed before

            delete_recording(self._recording.path)

    def _needs(self, now: int) -> None:
        """Tell the recording which of its files may still be needed."""
        begins = self._saver.begins()
        begins += [self._open.event.begin] if self._open else []
        if self._given.trigger or self._given.only_events:
            begins.append(now - round(self._given.before * SECOND))
        self._recording.needed_from = min(begins, default=inf)

    def _end(self, one: _Open) -> None:
        """Hand an event to the thread that saves it."""
        self._open = None
        self._saver.save(one.number, one.event)
