"""How complete a recording is, topic by topic, as its recorder knew and the bag tells.

A named record in each MCAP file, ``agv_motion.completeness``: of each topic, as JSON, how many of
its messages were recorded into that file, how many its publishers had numbered and never came, and
how many came and found no room. It tells of the recording, also in a bag that was cut out of it.
"""

from __future__ import annotations

import json
from functools import reduce
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.mcap.records import Metadata

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from agv_motion.bag.mcap.records import Attachment
    from agv_motion.bag.reader import BagReader

NAME = 'agv_motion.completeness'
_MOST = 10**15
"""messages that anyone could believe"""


class Completeness(NamedTuple):
    """What became of the messages of a topic, or of several together."""

    recorded: int = 0
    lost: int = 0
    """numbered by their publisher, and never came"""
    dropped: int = 0
    """came, and the disk was too slow or full"""

    @property
    def missing(self) -> int:
        """Messages that were sent and are not there."""
        return self.lost + self.dropped

    @property
    def share(self) -> float:
        """Share of the messages sent that were recorded, as far as is known; 1 without any."""
        sent = self.recorded + self.missing
        return self.recorded / sent if sent else 1.0

    def plus(self, other: Completeness) -> Completeness:
        """Return the sums."""
        return Completeness(*map(sum, zip(self, other, strict=True)))

    def since(self, before: Completeness) -> Completeness:
        """Return what is new since ``before``."""
        return Completeness(*(max(a - b, 0) for a, b in zip(self, before, strict=True)))

    def __str__(self) -> str:
        """Return it as a person reads it: never 100 % where one is missing."""
        if not self.missing:
            return '100 % complete'
        percent = min(int(self.share * 10_000) / 100, 99.99)
        return f'{percent:.2f} % complete ({self.lost} lost on the way, {self.dropped} dropped)'


NOTHING = Completeness()


def as_record(topics: Mapping[str, Completeness]) -> Metadata:
    """Return the record of a file."""
    return Metadata(NAME, {topic: json.dumps(one._asdict()) for topic, one in topics.items()})


def completeness(bag: BagReader) -> dict[str, Completeness]:
    """Return what a bag tells of each topic; empty where its recorder told nothing."""
    return of_records(extra for file in bag.files for extra in file.extras())


def of_records(extras: Iterable[Attachment | Metadata | Exception]) -> dict[str, Completeness]:
    """Return the sums over all records of files, for each topic."""
    found: dict[str, Completeness] = {}
    for extra in extras:
        if isinstance(extra, Metadata) and extra.name == NAME:
            for topic, text in extra.entries.items():
                one = _parsed(text)
                if one is not None:
                    found[topic] = found.get(topic, NOTHING).plus(one)
    return found


def together(topics: Mapping[str, Completeness]) -> Completeness:
    """Return the sums over all topics."""
    return reduce(Completeness.plus, topics.values(), NOTHING)


def _parsed(text: str) -> Completeness | None:
    """Return what a record tells of a topic; None where that cannot be."""
    try:
        entries = json.loads(text)
        numbers = [entries[name] for name in Completeness._fields]
    except (ValueError, LookupError, TypeError, RecursionError):
        return None
    fits = all(type(number) is int and 0 <= number <= _MOST for number in numbers)
    return Completeness(*numbers) if fits else None
