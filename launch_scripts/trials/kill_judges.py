"""What must hold of the files that an ended run leaves, seen by us and by independent readers."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcap.exceptions import McapError
from mcap.reader import NonSeekingReader, SeekingReader
from rosbags.rosbag2 import Reader, ReaderError

from agv_motion.bag.catalog.index import NAME as INDEX
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterator

    Files = dict[str, bytes]
    Row = tuple[Any, ...]


def files(folder: Path) -> Files:
    """Return all files below a folder, by their names in it."""
    found = sorted(p for p in folder.rglob('*') if p.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in found}


def shown(found: Files) -> Files:
    """Return the files that look like results: not hidden, and not marked as unfinished."""
    return {
        name: content
        for name, content in found.items()
        if not name.endswith('.tmp') and not any(p.startswith('.') for p in Path(name).parts)
    }


def index(folder: Path) -> list[Row]:
    """Return what the index of a folder tells of each bag and topic, after a check of the file."""
    with closing(sqlite3.connect(folder / INDEX)) as database:
        ask = database.execute
        return [
            *ask('PRAGMA integrity_check'),
            *ask('SELECT path, signature, start, stop, messages, fault FROM bag ORDER BY path'),
            *ask(
                'SELECT path, name, type, topic.messages, topic.size FROM topic '
                'JOIN bag ON bag.id = topic.bag ORDER BY path, name'
            ),
        ]


def unpaid(folder: Path) -> list[str]:
    """Return what is left in a folder of events: journals, halves, and bags that are torn."""
    halves = [name for name in files(folder) if name.startswith('.')]
    return halves + [f'{path.name}: {told}' for path in events(folder) if (told := torn(path))]


def events(folder: Path) -> list[Path]:
    """Return the bags in a folder of events."""
    return sorted(folder.glob('event_*'))


def bag(path: Path, saved: Path) -> Iterator[str]:
    """Yield what is wrong with a bag that was being written: torn is right where it is told.

    Args:
        path: Its folder.
        saved: Where to try whether it can be recovered; must not exist.

    """
    try:
        with BagReader(path) as reader:
            ours = [(m.connection.topic, m.stamp, m.data) for m in reader.messages()]
            lossy = reader.lossy
            problems = '; '.join(map(str, reader.problems))
    except SourceError:
        ours, lossy, problems = [], True, 'no bag'
    theirs, refused = _by_rosbags(path)
    if theirs is not None and sorted(theirs) != sorted(ours):
        yield f'rosbags reads {len(theirs)} messages as if all were whole, we {len(ours)}'
    if theirs is None and not lossy:
        yield f'we call it whole, rosbags says {refused}'
    for file in sorted(path.glob('*.mcap')):
        yield from _by_mcap(file)
    if problems == 'no bag':
        return
    with BagWriter(saved) as writer:
        Recovery(writer).save(path)
    kept, _ = _by_rosbags(saved)
    if sorted(kept or ()) != sorted(ours):
        yield f'{len(ours)} messages can be read, {len(kept or ())} are recovered'


def _by_rosbags(path: Path) -> tuple[list[Row] | None, str]:
    """Return all messages; None, and why, where the bag is refused."""
    try:
        with Reader(path) as reader:
            return [(c.topic, stamp, bytes(data)) for c, stamp, data in reader.messages()], ''
    except (ReaderError, OSError) as error:
        return None, str(error)


def _by_mcap(path: Path) -> Iterator[str]:
    """Yield what is wrong with a file that mcap's own reader takes for whole."""
    try:
        with path.open('rb') as stream:
            summary = SeekingReader(stream, validate_crcs=True).get_summary()
    except McapError:
        return
    if summary is None or summary.statistics is None:
        return
    told = summary.statistics.message_count
    with path.open('rb') as stream:
        reader = NonSeekingReader(stream, validate_crcs=True)
        found = sum(1 for _ in reader.iter_messages(log_time_order=False))
    if found != told:
        yield f'{path.name} tells of {told} messages, and mcap finds {found}'


def torn(path: Path) -> str:
    """Return what is missing in a bag; empty where it is whole."""
    try:
        with BagReader(path) as reader:
            return '; '.join(map(str, reader.problems)) if reader.lossy else ''
    except SourceError as error:
        return str(error)
