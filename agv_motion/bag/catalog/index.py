"""The index of a folder of bags: a small SQLite file that only ever reads what is new.

It lies hidden in the folder, or where nothing can be written there, in the user's cache. It holds
nothing that the bags do not tell: one that is damaged, or of another version, is made anew.
"""

from __future__ import annotations

import os
import sqlite3
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, final

from agv_motion.bag.catalog.discovery import bags_below, signature
from agv_motion.bag.catalog.entry import entry_of
from agv_motion.bag.sqlite.file import LATEST
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from types import TracebackType

    from agv_motion.bag.catalog.entry import BagEntry

NAME = '.agv_bags.sqlite3'
VERSION = 3
MOST_MESSAGES = 2**50
"""of a bag; what a damaged one tells beyond would make sums that SQLite cannot hold"""
TOGETHER = 50
"""bags that are written at a time: a kill loses no more of the work"""
_PATIENCE = 30.0
"""[s] for which another process may have the file"""
_TABLES = """
CREATE TABLE bag (id INTEGER PRIMARY KEY, path BLOB UNIQUE NOT NULL, signature TEXT NOT NULL,
    start INTEGER NOT NULL, stop INTEGER NOT NULL, messages INTEGER NOT NULL, size INTEGER NOT NULL,
    fault TEXT NOT NULL) STRICT;
CREATE TABLE topic (bag INTEGER NOT NULL REFERENCES bag ON DELETE CASCADE, name TEXT NOT NULL,
    type TEXT NOT NULL, messages INTEGER NOT NULL, size REAL) STRICT;
CREATE INDEX topic_of_bag ON topic (bag);
CREATE INDEX bag_of_topic ON topic (name);
"""


class IndexReport(NamedTuple):
    """What an update did."""

    bags: int
    """that are in the index now"""
    read: int
    """new or changed ones"""
    gone: int
    damaged: int


def _in_turn(bags: list[Path]) -> Iterator[tuple[Path, BagEntry]]:
    for path in bags:
        yield path, entry_of(path)


@final
class BagIndex:
    """An open index; close it, or use it as a context."""

    def __init__(self, folder: Path) -> None:
        """Open the index of a folder, or make one.

        Raises:
            SourceError: There is no such folder, or no place for the index.

        """
        if not folder.is_dir():
            msg = f'{folder} is no folder: give one in which, or below which, bags lie'
            raise SourceError(msg)
        self.folder = folder.resolve()
        self.path, self.database = _opened(self.folder)

    def update(
        self, tell: Callable[[int, int], None] = lambda _done, _all: None,
        read: Callable[[list[Path]], Iterable[tuple[Path, BagEntry]]] = _in_turn,
    ) -> IndexReport:  # fmt: skip
        """Read bags that are new or have changed, and forget those that are gone.

        Args:
            tell: Called with the number of bags that are done, and of all.
            read: Yields what is in each of some bags, in any order; one that it leaves out is read
                by the next update.

        Raises:
            SourceError: The disk takes nothing.

        """
        with _told(self.path):
            known = dict(self.database.execute('SELECT path, signature FROM bag'))
            found = {os.fsencode(p.relative_to(self.folder)): p for p in bags_below(self.folder)}
            gone = known.keys() - found.keys()
            self.database.executemany('DELETE FROM bag WHERE path = ?', [(p,) for p in gone])
            new = {}
            for name, path in sorted(found.items()):
                with suppress(OSError):  # gone meanwhile: the next update knows
                    mark = signature(path)
                    if known.get(name) != mark:
                        new[path] = name, mark
            done = len(found) - len(new)
            tell(done, len(found))
            for number, (path, entry) in enumerate(read(list(new)), 1):
                self._put(*new[path], entry)
                if not number % TOGETHER:
                    self.database.commit()
                tell(done + number, len(found))
            self.database.commit()
            (damaged,) = self.database.execute(
                "SELECT count() FROM bag WHERE fault != ''"
            ).fetchone()
        return IndexReport(len(found), len(new), len(gone), damaged)

    def ask(self, query: str, values: Sequence[Any] = ()) -> list[Any]:
        """Return the rows that answer a query.

        Raises:
            SourceError: The file is damaged.

        """
        with _told(self.path):
            return self.database.execute(query, values).fetchall()

    def decoded(self, path: bytes) -> Path:
        """Return where a bag lies whose path is in the index."""
        return self.folder / os.fsdecode(path)

    def close(self) -> None:
        """Let go of the file."""
        self.database.close()

    def __enter__(self) -> BagIndex:
        """Return the index."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close it."""
        self.close()

    def _put(self, name: bytes, mark: str, entry: BagEntry) -> None:
        put = self.database.execute
        put('DELETE FROM bag WHERE path = ?', (name,))
        span = min(entry.start, LATEST), min(entry.end, LATEST)
        (number,) = put(
            'INSERT INTO bag (path, signature, start, stop, messages, size, fault) '
            'VALUES (?, ?, ?, ?, ?, ?, ?) RETURNING id',
            (name, mark, *span, _count(entry.messages), entry.size, _text(entry.fault)),
        ).fetchone()
        rows = [
            (number, _text(t.name), _text(t.type), _count(t.messages), t.size) for t in entry.topics
        ]
        self.database.executemany('INSERT INTO topic VALUES (?, ?, ?, ?, ?)', rows)


def _count(messages: int) -> int:
    return min(messages, MOST_MESSAGES)


def _text(given: str) -> str:
    """Return a text as SQLite holds it: bytes that are none are replaced."""
    return given.encode(errors='replace').decode()


class _told:  # noqa: N801 - a context
    """Turns what SQLite refuses into a SourceError."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def __enter__(self) -> None:
        pass

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: object
    ) -> None:
        if isinstance(error, sqlite3.Error):
            msg = f'the index {self._path} cannot be used ({error}): delete it, or free the disk'
            raise SourceError(msg) from error


def _decoded(text: bytes) -> str:
    return text.decode(errors='replace')


def _opened(folder: Path) -> tuple[Path, sqlite3.Connection]:
    """Return the first place that takes an index, and the index there."""
    cache = Path(os.environ.get('XDG_CACHE_HOME') or Path.home() / '.cache') / 'agv_motion'
    elsewhere = cache / f'{sha256(bytes(folder)).hexdigest()[:32]}.sqlite3'
    with suppress(OSError, sqlite3.Error):
        return folder / NAME, _database(folder / NAME)
    try:
        cache.mkdir(parents=True, exist_ok=True)
        return elsewhere, _database(elsewhere)
    except (OSError, sqlite3.Error) as error:
        msg = f'no place for the index of {folder} ({error}): make it, or XDG_CACHE_HOME, writable'
        raise SourceError(msg) from error


def _database(path: Path) -> sqlite3.Connection:
    """Return the index in a file, which is made anew where it is none of this version."""
    database = sqlite3.connect(path, timeout=_PATIENCE)
    database.text_factory = _decoded
    try:
        database.execute('PRAGMA foreign_keys = ON')
        (version,) = database.execute('PRAGMA user_version').fetchone()
        sound = version == VERSION and database.execute('PRAGMA quick_check').fetchone() == ('ok',)
        if sound:
            database.execute('BEGIN IMMEDIATE')  # can it be written?
            database.rollback()
            return database
    except sqlite3.OperationalError:
        database.close()
        raise
    except sqlite3.DatabaseError:  # no database
        pass
    database.close()
    path.unlink(missing_ok=True)
    database = sqlite3.connect(path, timeout=_PATIENCE)
    database.text_factory = _decoded
    database.executescript(f'PRAGMA foreign_keys = ON;{_TABLES}PRAGMA user_version = {VERSION};')
    return database
