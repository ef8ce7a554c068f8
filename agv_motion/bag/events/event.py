"""An event: when what happened, which time around it is kept, and how its bag tells of it."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass, replace
from datetime import datetime, timezone
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.bag.mcap.records import Metadata

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.bag.events.event_parameters import EventParameters
    from agv_motion.bag.reader import BagReader

NAME = 'agv_motion.event'
"""of the named strings in a bag that tell of its event"""
SECOND = 10**9
MOST_MOMENTS = 100
"""that an event tells; of more it tells their number"""
_LONGEST_NAME = 60


class Moment(NamedTuple):
    """When something happened, and what."""

    stamp: int
    """[ns] log time"""
    reason: str


@dataclass(frozen=True)
class Event:
    """Moments on end, and the time around them."""

    moments: tuple[Moment, ...]
    begin: int
    """[ns] first log time of the bag"""
    end: int
    """[ns] last log time"""
    more: int = 0
    """moments that are not told"""
    cut_short: str = ''
    """why the recording ended before the event did; empty: it did not"""

    @property
    def first(self) -> Moment:
        """What began it."""
        return self.moments[0]

    def takes(self, moment: Moment) -> bool:
        """Return whether something happened before this event was over."""
        return self.begin <= moment.stamp <= self.end

    def joined(self, moment: Moment, given: EventParameters) -> Event:
        """Return the event with what happened before it was over, and so goes on for longer."""
        limit = self.first.stamp + _nanoseconds(given.longest_event)
        end = max(self.end, min(moment.stamp + _nanoseconds(given.after), limit))
        if len(self.moments) >= MOST_MOMENTS:
            return replace(self, end=end, more=self.more + 1)
        return replace(self, end=end, moments=(*self.moments, moment))

    def folder_name(self) -> str:
        """Return the name of its bag: when, and why."""
        when = datetime.fromtimestamp(self.first.stamp // SECOND, timezone.utc)
        words = re.sub(r'[^A-Za-z0-9.]+', '_', self.first.reason).strip('_.')
        return f'event_{when:%Y_%m_%d-%H_%M_%S}Z_{words[:_LONGEST_NAME].strip("_.") or "marked"}'

    def record(self) -> Metadata:
        """Return the named strings that tell of it in its bag."""
        entries = {
            'reason': self.first.reason,
            'stamp': str(self.first.stamp),
            'moments': json.dumps(self.moments),
            'more': str(self.more),
            'begin': str(self.begin),
            'end': str(self.end),
            'cut_short': self.cut_short,
        }
        return Metadata(NAME, entries)

    def entries(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return asdict(self)


def new_event(moment: Moment, given: EventParameters) -> Event:
    """Return the event that something begins."""
    begin = max(moment.stamp - _nanoseconds(given.before), 0)
    after = min(given.after, given.longest_event)
    return Event((moment,), begin, moment.stamp + _nanoseconds(after))


def from_entries(entries: Any) -> Event | None:
    """Return an event that JSON held; None where there is none."""
    try:
        moments = tuple(Moment(_stamp(stamp), str(reason)) for stamp, reason in entries['moments'])
        begin, end = _stamp(entries['begin']), _stamp(entries['end'])
        more, cut_short = int(entries['more']), str(entries['cut_short'])
    except (LookupError, TypeError, ValueError, OverflowError):
        return None
    sound = moments and begin <= moments[0].stamp and begin <= end
    return Event(moments, begin, end, more, cut_short) if sound else None


def events_of(bag: BagReader) -> list[Event]:
    """Return the events of which a bag tells: none, unless a black box made it."""
    return list(_events(extra for file in bag.files for extra in file.extras()))


def _events(extras: Iterable[Any]) -> Iterator[Event]:
    for extra in extras:
        if isinstance(extra, Metadata) and extra.name == NAME:
            try:
                entries = {**extra.entries, 'moments': json.loads(extra.entries['moments'])}
                span = {key: int(extra.entries[key]) for key in ('begin', 'end')}
            except (ValueError, LookupError, RecursionError):
                continue
            found = from_entries(entries | span)
            if found is not None:
                yield found


def _stamp(value: Any) -> int:
    if type(value) is not int or not 0 <= value < 2**64:
        raise ValueError(value)
    return value


def _nanoseconds(seconds: float) -> int:
    return round(seconds * SECOND)
