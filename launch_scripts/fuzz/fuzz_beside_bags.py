"""The doors of what lies beside bags: the index of many, journals of events, and triggers."""

from __future__ import annotations

import tempfile
from functools import partial
from math import isfinite
from pathlib import Path
from struct import pack
from typing import TYPE_CHECKING

from fuzz_files import damaged, file_door, flipped

from agv_motion.bag.catalog.find import Question
from agv_motion.bag.catalog.find import find as ask
from agv_motion.bag.catalog.index import NAME, BagIndex
from agv_motion.bag.catalog.statistics import Period, amounts, topic_amounts
from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.events.event_parameters import EventParameters
from agv_motion.bag.events.event_saver import owed
from agv_motion.bag.events.journal import left_behind
from agv_motion.bag.events.trigger import Trigger
from agv_motion.bag.writer import BagWriter

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator

EVENT = '{"moments": [[5, "slip"], [6, "/state ~ stopped"]], "begin": 1, "end": 9, "more": 2'
JOURNAL = (
    '{"recording": "/bags/walk", "only_events": true, "before": 30.0}\n'
    f'{{"number": 1, "event": {EVENT}, "cut_short": ""}}}}\n{{"number": 1}}\n'
    f'{{"number": 2, "event": {EVENT}, "cut_short": "the recording ended"}}}}\n'
)
DEFINITION = 'string data\nfloat64 residual\nfloat64[] position'
SEEN = Message(
    Connection('/t', 'a/msg/A', DEFINITION, 'ros2msg', 'cdr', '', ()),
    5, b'\0\1\0\0' + pack('<I4sdI4xd', 4, b'abc\0', 0.5, 1, 2.0), 5, 0,
)  # fmt: skip


def index_door(folder: Path) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of the index of many bags: a file of SQLite."""
    for name in 'ab':
        with BagWriter(folder / name) as bag:
            bag.write(bag.add_topic(f'/{name}', 'a/msg/A', 'int8 x', type_hash=''), 5, bytes(5))

    def act() -> None:
        with BagIndex(folder) as index:
            assert index.update().bags == 2
            list(ask(index, Question(topics=('/a',))))
            amounts(index, Question(), Period.DAY, 60.0)
            topic_amounts(index, Question())

    act()
    sound = (folder / NAME).read_bytes()

    def door(rng: random.Random) -> Callable[[], None]:
        (folder / NAME).write_bytes(flipped(sound, rng))
        return act

    return door


def read_journal(path: Path) -> None:
    """Ask a journal for the events that its recorder owes."""
    for journal, left in left_behind(path.parent):
        assert isfinite(left.before)
        try:
            for _, event in owed(left, 7, journal):
                assert event.begin <= event.first.stamp
                event.folder_name()
                event.record()
        finally:
            journal.close(done=False)


def watch(text: str) -> None:
    """Let a trigger see a message."""
    for wanted in EventParameters(trigger=(text,)).conditions():
        trigger = Trigger(wanted)
        trigger.bind(SEEN.connection)
        assert all(moment.stamp == SEEN.stamp for moment in trigger.moments([SEEN]))


def doors() -> Iterator[tuple[str, Callable[[random.Random], Callable[[], None]]]]:
    """Yield the doors by name."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind in ('season', 'events'):
            (folder / kind).mkdir()
        yield 'database index.sqlite3', index_door(folder / 'season')
        journal = folder / 'events' / '.walk.events.jsonl'
        yield 'file journal.jsonl', file_door(journal, JOURNAL, read_journal)
        for number, text in enumerate(('/t/residual > 0.02', '/t/position[0] >= 1', '/t ~ abc')):
            yield (
                f'text trigger {number}',
                lambda rng, text=text: partial(watch, damaged(text, rng).decode(errors='replace')),
            )
