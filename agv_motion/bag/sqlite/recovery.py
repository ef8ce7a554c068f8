"""What can be read of a damaged sqlite3 file, as a whole one."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from agv_motion.bag.sqlite.aside import set_aside
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

FARTHEST = 1 << 40
"""Rows: nothing is sought so far beyond the last that can be read."""


def copy_readable(damaged: Path, copy: Path) -> list[SourceError]:
    """Write into ``copy`` every row of ``damaged`` that can be read.

    A file that was cut off keeps all rows before the cut; pages overwritten in the middle cost the
    rows on them.

    Args:
        damaged: The file, which stays as it is.
        copy: The new file; must not exist.

    Returns:
        What is missing.

    Raises:
        SourceError: Not even the list of tables can be read.

    """
    problems: list[str] = []
    with (
        TemporaryDirectory() as folder,
        closing(_opened(damaged, Path(folder))) as source,
        closing(sqlite3.connect(copy)) as target,
    ):
        source.execute('pragma writable_schema = on')  # else a file that was cut off is refused
        try:
            tables = source.execute(
                "select name, sql from sqlite_master where sql like 'create table %'"
            ).fetchall()
        except sqlite3.DatabaseError as error:
            msg = f'{damaged} cannot be read as a bag in sqlite3: {error}'
            raise SourceError(msg) from error
        for name, statement in tables:
            problems += _copy_table(source, target, name, statement)
        target.commit()
    return [SourceError(f'{damaged}, {problem}') for problem in problems]


def _opened(damaged: Path, folder: Path) -> sqlite3.Connection:
    """Return a file opened, with its write-ahead log if that can be used."""
    try:
        aside = set_aside(damaged, folder)
    except sqlite3.DatabaseError:
        aside = damaged
    return sqlite3.connect(f'{aside.absolute().as_uri()}?mode=ro&immutable=1', uri=True)


def _copy_table(
    source: sqlite3.Connection, target: sqlite3.Connection, name: str, statement: str
) -> list[str]:
    """Copy the rows of one table; return what is missing."""
    problems: list[str] = []
    try:
        target.execute(statement)
        for row in _rows(source, name, problems):
            places = ', '.join('?' * len(row))
            target.execute(f'insert or ignore into {_quoted(name)} values ({places})', row)  # noqa: S608
    except sqlite3.Error as error:
        problems.append(str(error))
    return [f'table {name}: {problem}' for problem in problems]


def _rows(source: sqlite3.Connection, table: str, problems: list[str]) -> Iterator[tuple[Any, ...]]:
    """Yield the rows of a table by their number, past stretches that cannot be read."""
    query = f'select rowid, * from {_quoted(table)} where rowid > ? order by rowid'  # noqa: S608
    last: int | None = -1
    while last is not None:
        last = yield from _stretch(source, query, last, problems)


def _stretch(
    source: sqlite3.Connection, query: str, last: int, problems: list[str]
) -> Generator[tuple[Any, ...], None, int | None]:
    """Yield the rows after ``last`` that can be read; return after which to go on, if at all."""
    try:
        for number, *row in source.execute(query, (last,)):
            if number > last:  # else the tree of the table is damaged
                yield tuple(row)
                last = number
    except sqlite3.DatabaseError as error:
        beyond = _readable_from(source, query, last)
        upto = 'the end' if beyond is None else beyond
        problems.append(f'rows {last + 1} to {upto} cannot be read: {error}')
        return beyond
    return None


def _readable_from(source: sqlite3.Connection, query: str, last: int) -> int | None:
    """Return the number after which rows can be read again; None where there are none."""

    def reads(number: int) -> bool:
        try:
            source.execute(f'{query} limit 1', (number,)).fetchone()
        except sqlite3.DatabaseError:
            return False
        return True

    step = 1
    while not reads(last + step):
        step *= 2
        if step > FARTHEST:
            return None
    low, high = last + step // 2, last + step
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if reads(middle) else (middle, high)
    return high


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'
