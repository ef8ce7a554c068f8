"""Rows of a CSV file: each is read, or left out and told with its line; none costs another."""

from __future__ import annotations

import csv
from math import inf, nan
from typing import TYPE_CHECKING, NamedTuple, NoReturn

import numpy as np

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.files import text
from agv_motion.probe.sources.logger_line import MISSING
from agv_motion.probe.sources.recorded_time import parse_time, second_reading

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

LARGEST = 256 << 20
"""[bytes] of a recording: a year of three probes every second"""
MOST_TOLD = 3
"""Rows left out that are told one by one; the others are counted."""


class Row(NamedTuple):
    """A row of the file."""

    line: int
    """counted from 1"""
    cells: list[str]
    fault: str = ''
    """why its cells cannot be told apart"""


class _LeftOut:
    """Rows that cannot be read: each costs itself, and is told."""

    def __init__(self, path: Path) -> None:
        """Start without any."""
        self._path = path
        self._faults: list[tuple[int, int, str, str]] = []

    def add(self, line: int, column: int, reason: str, unquoted: str = '') -> None:
        """Note a row."""
        self._faults.append((line, column, reason, unquoted or reason))

    def refuse(self) -> NoReturn:
        """Raise what is wrong with the first row, or that there is none."""
        if not self._faults:
            msg = f'{self._path} has no row with a time: give at least one'
            raise SourceError(msg)
        line, column, reason, unquoted = self._faults[0]
        raise SourceError.at((self._path, line, column), reason, unquoted)

    def told(self) -> str:
        """Return how many there are, and the first few lines, without a word of the file."""
        if not self._faults:
            return ''
        first = '; '.join(f'line {line}: {why}' for line, _, _, why in self._faults[:MOST_TOLD])
        more = f'; and {left} more' if (left := len(self._faults) - MOST_TOLD) > 0 else ''
        return f'rows of {self._path} left out: {len(self._faults)} ({first}{more})'


class CsvTable(NamedTuple):
    """The rows of a file that can be read, in their order."""

    times: NDArray[np.float64]
    """[s] since 1970"""
    lines: NDArray[np.int64]
    """from which each row comes"""
    columns: dict[str, NDArray[np.float64]]
    """NaN where a cell is empty or no number"""
    problem: str
    """what was wrong; empty if nothing"""


def read_table(path: Path, time_column: str, names: Sequence[str]) -> CsvTable:
    """Return the columns ``names``; a row that cannot be read is left out and told.

    Raises:
        SourceError: The file cannot be read, no row can, or its times have two readings.
        ConfigurationError: A column is not in the file, or twice.

    """
    rows = rows_of(path)
    header = _header(path, next(rows, Row(1, [])), (time_column, *names))
    time_index = header.index(time_column)
    times, kept, left_out = _read_times(rows, len(header), time_index, path)
    if not kept:
        left_out.refuse()
    other = second_reading(row.cells[time_index].strip() for row in kept)
    if other:
        wrong = f"column '{time_column}' may be {other}"
        raise SourceError.at((path, kept[0].line, 1), wrong, f'the times may be {other}')
    columns, unreadable = {}, 0
    for name in set(names):
        index = header.index(name)
        numbers = [_number(row.cells[index]) for row in kept]
        unreadable += sum(number is None for number in numbers)
        columns[name] = np.array([nan if n is None else n for n in numbers], dtype=float)
    cells = f'{unreadable} cells of {path} are no numbers' if unreadable else ''
    problem = '; '.join(filter(None, (left_out.told(), cells)))
    return CsvTable(np.array(times), np.array([row.line for row in kept]), columns, problem)


def _read_times(
    rows: Iterator[Row], width: int, time_index: int, path: Path
) -> tuple[list[float], list[Row], _LeftOut]:
    """Return the times of the rows that can be read, those rows, and the others."""
    times: list[float] = []
    kept: list[Row] = []
    left_out = _LeftOut(path)
    for row in rows:
        if not row.fault and not any(map(str.strip, row.cells)):
            continue
        fault = row.fault or _misfit(row.cells, width)
        if fault:
            left_out.add(row.line, 1, fault)
            continue
        try:
            times.append(parse_time(row.cells[time_index], 'time'))
        except SourceError as error:
            column = sum(len(cell) + 1 for cell in row.cells[:time_index]) + 1
            left_out.add(row.line, column, str(error).partition(': ')[2], error.unquoted)
        else:
            kept.append(row)
    return times, kept, left_out


def _header(path: Path, row: Row, names: Sequence[str]) -> list[str]:
    """Return the names of the columns; those that are wanted are there once.

    Raises:
        ConfigurationError: One is not there, or twice.

    """
    header = [name.strip() for name in row.cells]
    for name in names:
        if name not in header:
            missing = f"no column '{name}'"
            has = f'{missing}: it has {", ".join(header):.200}'
            raise ConfigurationError.at((path, row.line, 1), has, missing)
        if header.count(name) > 1:
            twice = f"column '{name}' is there {header.count(name)} times: give each its own name"
            raise ConfigurationError.at((path, row.line, 1), twice, twice)
    return header


def _misfit(cells: list[str], count: int) -> str:
    """Return why a row does not fit under a header of ``count`` columns; empty if it does."""
    if len(cells) < count:
        return f'{len(cells)} cells under {count} columns: it is cut short'
    if any(map(str.strip, cells[count:])):
        return f'{len(cells)} cells under {count} columns: a comma in it may be decimal'
    return ''


def rows_of(path: Path) -> Iterator[Row]:
    """Yield each row that has any cells; a quotation ends in its line.

    Raises:
        SourceError: It cannot be read.

    """
    try:
        content = text.read(path, 'the probe file', LARGEST)
    except ConfigurationError as error:
        raise text.as_kind(error, SourceError) from error
    for number, line in enumerate(content.split('\n'), 1):
        if not line:
            continue
        try:
            yield Row(number, next(csv.reader((line,), strict=True)))
        except csv.Error as error:
            yield Row(number, [], f'no CSV: {error}')


def _number(cell: str) -> float | None:
    """Return the number of a cell, NaN where it is empty, None where it is something else."""
    cell = cell.strip()
    if cell.lower() in {'', 'na', 'nan', 'null', '-'}:
        return nan
    try:
        number = float(cell)
    except ValueError:
        return None
    if number in MISSING:
        return nan
    return number if abs(number) < inf and '_' not in cell else None
