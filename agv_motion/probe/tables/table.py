"""All files of a logger, in the order of time, and what comes to them while it writes."""

from __future__ import annotations

from glob import glob
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import AgvMotionError, SourceError
from agv_motion.probe.tables.table_file import TableFile

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.probe.tables.table_file import FileRows
    from agv_motion.probe.tables.table_parameters import TableParameters

ENDINGS = '.csv', '.dat', '.txt', '.tsv'
"""Of the files in a folder that are taken for a logger's."""


class LoggerTable(NamedTuple):
    """Rows of one or several files, in the order of time, none of them twice."""

    times: NDArray[np.float64]
    """[s] since 1970, UTC"""
    values: NDArray[np.float64]
    """(n, columns), in the unit of the file; NaN where there is none"""
    files: tuple[Path, ...]
    places: NDArray[np.int64]
    """(n, 2): which of ``files``, and which line of it, counted from 1"""
    problem: str
    """what was wrong; empty if nothing"""

    def place(self, row: int) -> str:
        """Return in words where a row stands."""
        file, line = self.places[row]
        return f'line {line}' if len(self.files) == 1 else f'{self.files[file]}, line {line}'


class LoggerTables:
    """The files that are meant, each read as far as it is written."""

    def __init__(self, given: TableParameters) -> None:
        """Read nothing yet."""
        self._given = given
        self._files: dict[Path, TableFile] = {}
        self._begun = False

    def read(self, *, growing: bool = False) -> LoggerTable:
        """Return the rows that were not read before, of files that are new too.

        Args:
            growing: Whether a logger may be writing. A file that it has begun anew is read anew,
                and one that cannot be read later is told in `LoggerTable.problem`.

        Raises:
            SourceError: There is no file, it cannot be read, or no row in it can.
            ConfigurationError: A column is not in it, or twice.

        """
        parts: dict[Path, FileRows] = {}
        troubles: list[str] = []
        for path in files_of(self._given.file):
            rows = self._new_rows(path, troubles, growing=growing)
            parts |= {} if rows is None else {path: rows}
        self._begun = True
        table = in_order(parts, len(self._given.columns))
        return table._replace(problem='; '.join(filter(None, (table.problem, *troubles))))

    def _new_rows(self, path: Path, troubles: list[str], *, growing: bool) -> FileRows | None:
        """Return the new rows of a file; None, and a trouble, where another's rows are to count."""
        try:
            return self._rows_of(path, growing=growing)
        except AgvMotionError as error:
            if not (growing and self._begun):
                raise
            troubles.append(str(error))
            return None

    def _rows_of(self, path: Path, *, growing: bool) -> FileRows | None:
        """Return what was not read before of a file; None where nothing is new."""
        if not growing:
            return TableFile(path, self._given).read(growing=False)
        known, size = self._files.get(path), _size_of(path)
        if known and size == known.bytes_read:
            return None
        if known is None or size < known.bytes_read or not known.is_as_read():
            if not size:
                return None
            known = self._files[path] = TableFile(path, self._given)
        return known.read(growing=True)


def _size_of(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError as error:
        msg = f"cannot read the probe file '{path}': {error.strerror or error}"
        raise SourceError(msg) from error


def read_tables(given: TableParameters) -> LoggerTable:
    """Return all that stands in the files.

    Raises:
        SourceError: There is no file, it cannot be read, or no row in it can.
        ConfigurationError: A column is not in it, or twice.

    """
    return LoggerTables(given).read()


def in_order(parts: dict[Path, FileRows], columns: int) -> LoggerTable:
    """Return rows in the order of time; of those of one time the last that was written."""
    rows = list(parts.values())
    times = np.concatenate([np.empty(0), *(part.times for part in rows)])
    values = np.concatenate([np.empty((0, columns)), *(part.values for part in rows)])
    places = np.concatenate(
        [
            np.empty((0, 2), np.int64),
            *(
                np.column_stack([np.full(len(part.lines), i), part.lines])
                for i, part in enumerate(rows)
            ),
        ]
    )
    order = np.argsort(times, kind='stable')
    last_of_repeated = np.append(np.diff(times[order]) > 0.0, True)[: len(times)]
    keep = order[last_of_repeated]
    problems = [part.problem for part in rows]
    if not np.array_equal(order, np.arange(len(times))):
        problems.append('rows were put into order')
    if len(keep) < len(times):
        problems.append(f'{len(times) - len(keep)} rows of a time that comes again dropped')
    problem = '; '.join(filter(None, problems))
    return LoggerTable(times[keep], values[keep], tuple(parts), places[keep], problem)


def files_of(file: str) -> Sequence[Path]:
    """Return the files that a path means: itself, all tables in a folder, or all of a pattern.

    Raises:
        SourceError: It means none.

    """
    path = Path(file)
    if path.is_dir():
        found = sorted(p for p in path.iterdir() if p.suffix.lower() in ENDINGS and p.is_file())
        if not found:
            msg = f"no file in '{path}' ends on {', '.join(ENDINGS)}: give the folder of the logger"
            raise SourceError(msg)
        return found
    if any(sign in file for sign in '*?[') and not path.exists():
        found = sorted(Path(name) for name in glob(file) if Path(name).is_file())  # noqa: PTH207 - it may be absolute
        if not found:
            msg = f"no file is called as '{file}'"
            raise SourceError(msg)
        return found
    return [path]
