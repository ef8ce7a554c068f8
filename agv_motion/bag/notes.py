"""Notes in a bag: a moment and a few words, in a file of their own beside the data.

One line of JSON a note, appended to ``notes.jsonl`` in the folder of the bag (``NAME.notes.jsonl``
beside a file that is a bag by itself). The data are never touched: a summary of MCAP that is
written anew in place, or a table of sqlite3, would be torn by a kill at the wrong moment, and a bag
that is being recorded belongs to its recorder. So the same holds for MCAP, for sqlite3, and while a
recording goes on; a kill or a full disk can leave a part of the new line, which is passed over.
"""

from __future__ import annotations

import fcntl
import json
import os
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.metadata import FILE_NAME
from agv_motion.errors import ConfigurationError
from agv_motion.files.unfinished import told

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

NAME = 'notes.jsonl'
LONGEST = 1000
"""characters of a note"""
_JOINER = '\u200d'
"""between the pictures that make one emoji"""
_MOST = 1 << 26
"""[bytes] of a file of notes that are read"""


class Note(NamedTuple):
    """What somebody noted."""

    stamp: int
    """[ns] log time that it is about"""
    text: str


def one_line(text: str) -> str:
    """Return what somebody wrote as a note can hold it: printable, on one line, not too long."""
    return _printable(text)[:LONGEST]


def notes_of(bag: Path) -> list[Note]:
    """Return the notes of a bag in the order of their time; lines that are none are passed over."""
    place = _place(bag)
    try:
        with place.open('rb') as file:
            lines = file.read(_MOST).splitlines()
    except OSError:
        return []
    return sorted(note for line in lines if (note := _parsed(line)) is not None)


def add_note(bag: Path, note: Note) -> None:
    """Append a note to a bag.

    Args:
        bag: Its folder, or file.
        note: The note.

    Raises:
        ConfigurationError: The note is empty, or too long.
        SourceError: The disk takes no more; the notes are as they were.

    """
    add_notes(_place(bag), [note])


def add_notes(place: Path, notes: Iterable[Note]) -> None:
    """Append notes to a file of them; errors as of :func:`add_note`."""
    data = b''.join(map(_line, notes))
    if not data:
        return
    with told(place):
        file = os.open(place, os.O_RDWR | os.O_APPEND | os.O_CREAT, 0o666)
        try:
            fcntl.flock(file, fcntl.LOCK_EX)
            size = os.fstat(file).st_size
            torn = size and os.pread(file, 1, size - 1) != b'\n'
            _append(file, b'\n' * bool(torn) + data, size)
            os.fsync(file)
        finally:
            os.close(file)


def carry(bags: Iterable[Path], folder: Path, spans: Iterable[tuple[int, int]] | None) -> int:
    """Write those notes of bags that lie in some spans [ns] into a new bag; return how many."""
    limits = None if spans is None else list(spans)
    found = sorted({note for bag in bags for note in notes_of(bag)})
    kept = [n for n in found if limits is None or any(a <= n.stamp < b for a, b in limits)]
    add_notes(folder / NAME, kept)
    return len(kept)


def _append(file: int, data: bytes, size: int) -> None:
    """Write all bytes, or none."""
    try:
        view = memoryview(data)
        while view:
            view = view[os.write(file, view) :]
    except OSError:
        os.ftruncate(file, size)
        raise


def _place(bag: Path) -> Path:
    if bag.is_dir():
        return bag / NAME
    if (bag.parent / FILE_NAME).is_file():  # one file of a bag
        return bag.parent / NAME
    return bag.with_name(f'{bag.name}.{NAME}')


def _printable(text: str) -> str:
    """Return a text on one line, without what moves a cursor or turns the direction of writing."""
    return ' '.join(''.join(c if c.isprintable() or c == _JOINER else ' ' for c in text).split())


def _line(note: Note) -> bytes:
    text = _printable(note.text)
    if not 0 < len(text) <= LONGEST:
        msg = f'a note of {len(text)} characters: expected 1 to {LONGEST}'
        raise ConfigurationError(msg)
    if not 0 <= note.stamp < 2**64:
        msg = f'a note at {note.stamp} ns: expected nanoseconds since 1970 in [0, 2^64)'
        raise ConfigurationError(msg)
    entry = {'stamp': note.stamp, 'text': text}
    return json.dumps(entry, ensure_ascii=True).encode() + b'\n'


def _parsed(line: bytes) -> Note | None:
    """Return the note on a line; None where there is none, or a half."""
    try:
        entry = json.loads(line)
        stamp, text = entry['stamp'], entry['text']
    except (ValueError, LookupError, TypeError, RecursionError):
        return None
    fits = type(stamp) is int and isinstance(text, str) and 0 <= stamp < 2**64
    return Note(stamp, one_line(text)) if fits else None
