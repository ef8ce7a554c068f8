"""What a file seems to be: the columns it has, which of them tell the time, and in what format."""

from __future__ import annotations

import csv
import re
from collections import Counter
from itertools import chain
from statistics import mode
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import AgvMotionError, SourceError
from agv_motion.files import text
from agv_motion.probe.tables import file_text
from agv_motion.probe.tables.signs import DELIMITERS, JOIN
from agv_motion.probe.tables.table import files_of
from agv_motion.probe.tables.table_file import LARGEST
from agv_motion.probe.tables.table_form import HEAD, is_number, split
from agv_motion.probe.tables.table_parameters import TableParameters
from agv_motion.probe.tables.time_format import choose, readings
from agv_motion.probe.tables.time_readers import OF_COLUMNS

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.probe.tables.file_text import FileLine

HEAD_BYTES = 1 << 18
"""of a file, which are more than the rows by which it is judged"""
LOOKED_AT = 400
"""Rows by which a file is judged."""
MOST = 0.6
"""Share of the rows that has to agree."""
PARTS = 6, 5, 4, 3, 2
"""Columns that may make one time: year, month, day, hour, minute, second, or year and day."""
IN_A_ROW = 3
"""Rows of data by which their begin is known: a line of the logger's name may look like one."""
PROBE_WORDS = 'probe', 'delta', 'dt', 'granier', 'sap', 'mv', 'volt', 'tdp', 'tdm'
TIME_WORDS = 'time', 'date', 'stamp', 'datum', 'zeit', 'heure'
NO_VALUE = TableParameters().missing
_CLOCK = re.compile(r'\d{1,2}:\d{2}(?::\d{2}(?:\.\d+)?)?|\d{4}', re.ASCII)


class Column(NamedTuple):
    """A column of a file."""

    name: str
    """its number, counted from 1, where the file has no names"""
    cells: tuple[str, ...]
    """of the first rows"""

    def is_of_numbers(self) -> bool:
        """Tell whether most of its cells are numbers, but for those that stand for none."""
        told = [cell for cell in self.cells if cell and cell.lower() not in NO_VALUE]
        numbers = sum(map(is_number, told))
        return numbers > 0 and numbers >= MOST * len(told)


class Inspection(NamedTuple):
    """What the first rows of a file show."""

    files: tuple[Path, ...]
    encoding: str
    delimiter: str
    """as `csv.delimiter` calls it"""
    header: int
    """number of the line with the names; 0 where there is none"""
    columns: tuple[Column, ...]
    time_column: str
    """as `csv.time_column` has it; empty where none is seen"""
    time_formats: tuple[str, ...]
    """that read it, as `csv.time_format` calls them: one, or several that tell other times"""

    def numbers(self) -> list[str]:
        """Return the columns of numbers that tell no time."""
        times = {part.strip() for part in self.time_column.split(JOIN)} | {self.time_column}
        return [c.name for c in self.columns if c.name not in times and c.is_of_numbers()]

    def probes(self) -> list[str]:
        """Return those whose names sound like probes."""
        return [name for name in self.numbers() if sounds_like(name, PROBE_WORDS)]


def sounds_like(name: str, words: Sequence[str]) -> bool:
    """Tell whether a name has one of the words in it."""
    return any(word in name.lower() for word in words)


def inspect(file: str) -> Inspection:
    """Look at the first of the files that a path means.

    Raises:
        SourceError: It cannot be read, or has no rows.

    """
    files = tuple(files_of(file))
    try:
        data = text.read_bytes(files[0], 'the probe file', LARGEST)
    except AgvMotionError as error:
        raise text.as_kind(error, SourceError) from error
    data = data[:HEAD_BYTES]
    encoding = file_text.encoding_of(data[: data.rfind(b'\n') + 1] or data, 'auto', file)
    told = data.decode(encoding, errors='replace')
    file_text.require_text(data, told, str(files[0]))
    lines = file_text.lines_of(told)
    lines = [line for line in lines if not line.fault]
    rows: dict[str, list[tuple[int, list[str]]]] = {
        name: _rows(lines, delimiter) for name, delimiter in DELIMITERS.items()
    }
    delimiter = max(rows, key=lambda name: _clean_share(rows[name]))
    if not rows[delimiter]:
        msg = f'{file} has no row: give a file with a row of names and rows of numbers'
        raise SourceError(msg)
    width = _usual_width(rows[delimiter])
    _require_points(rows[delimiter], width, str(files[0]))
    table = [row for row in rows[delimiter] if len(row[1]) >= width]
    of_data = [_is_data(cells) for _, cells in table]
    begin = next((i for i in range(len(table)) if all(of_data[i : i + IN_A_ROW])), len(table))
    head = [row for row in table[:begin] if len(set(row[1])) > 1]
    header, names = max(
        head,
        # a line of the station may have more cells than the names under it
        key=lambda row: (len(row[1]) == width, len(set(filter(None, row[1])))),
        default=(0, []),
    )
    names = [name.lstrip('# ') for name in names]
    numbers = [str(i + 1) for i in range(max(width, len(names)))]
    names = [
        name if names.count(name) == 1 else n
        for name, n in zip(names or numbers, numbers, strict=False)
    ]
    body = [cells for _, cells in table[begin:]]
    columns = tuple(
        Column(name, tuple(cells[i] for cells in body if i < len(cells)))
        for i, name in enumerate(names)
        if name
    )
    return Inspection(files, encoding, delimiter, header, columns, *_time_of(columns))


def _require_points(rows: Sequence[tuple[int, list[str]]], width: int, file: str) -> None:
    """Refuse rows of a time and pairs of whole numbers under a name for each pair.

    Raises:
        SourceError: They are so: commas stand between the columns, and in the numbers too.

    """
    data = [cells for _, cells in rows if len(cells) == width and _is_data(cells)]
    if not data:
        return
    number, names = next(row for row in rows if len(row[1]) > 1)
    if (
        width == 2 * len(names) - 1
        and not any(map(is_number, names))
        and all(cell.lstrip('+-').isdecimal() for cells in data for cell in cells[1:])
    ):
        msg = (
            f'{file}, line {number}: {len(names)} names over rows of {width} cells of whole '
            'numbers: the sign between its columns is in its numbers too; save it with another'
        )
        raise SourceError(msg)


def _rows(lines: Sequence[FileLine], delimiter: str) -> list[tuple[int, list[str]]]:
    found = []
    for line in lines[: HEAD + LOOKED_AT]:
        number, words = line.number, line.text
        try:
            cells = split(words, delimiter)
        except csv.Error:
            continue
        if len(cells) > 1 or not words.startswith('#'):
            found.append((number, cells))
    return found


def _usual_width(rows: Sequence[tuple[int, list[str]]]) -> int:
    return mode(len(cells) for _, cells in rows)


def _clean_share(rows: Sequence[tuple[int, list[str]]]) -> float:
    """Return how many of the cells are each one thing: a number, a time, nothing, a mere word."""
    if not rows or _usual_width(rows) < 2:
        return 0.0
    data = [cells for _, cells in rows if _is_data(cells)]
    cells = list(chain.from_iterable(data))
    return sum(map(_is_clean, cells)) / len(cells) if cells else 0.0


def _is_clean(cell: str) -> bool:
    return (
        not cell
        or is_number(cell)
        or bool(readings(cell))
        or bool(_CLOCK.fullmatch(cell))
        or (cell.isalpha())
    )


def _is_data(cells: Sequence[str]) -> bool:
    """Tell whether a row has a number and, before it, something of a time in it."""
    return (
        len(cells) > 1
        and any(map(is_number, cells))
        and any(any(map(str.isdecimal, cell)) for cell in cells[:2])
    )


def _time_of(columns: Sequence[Column]) -> tuple[str, tuple[str, ...]]:
    """Return which columns tell the time, and the formats that read them."""
    ranked = sorted(columns, key=lambda column: not sounds_like(column.name, TIME_WORDS))
    for column in ranked:
        named = sounds_like(column.name, TIME_WORDS) or column is columns[0]
        formats = _formats(column.cells)
        if not formats or (_are_numbers(column.cells) and not named):
            continue
        clock = _clock_beside(column, columns)
        return (f'{column.name} {JOIN} {clock}' if clock else column.name), formats
    for length in PARTS:
        for begin in range(len(columns) - length):
            parts = columns[begin : begin + length]
            words = [' '.join(row) for row in zip(*(part.cells for part in parts), strict=False)]
            whole = all(map(str.isdecimal, chain.from_iterable(part.cells for part in parts)))
            formats = _formats(words) if whole or length == 2 else ()
            if formats and set(formats) <= set(OF_COLUMNS):
                return f' {JOIN} '.join(part.name for part in parts), formats
    return '', ()


def _are_numbers(words: Sequence[str]) -> bool:
    return all(map(is_number, words))


def _formats(words: Sequence[str]) -> tuple[str, ...]:
    """Return the formats that read most of the words: one, unless they are numbers alone."""
    found = Counter(chain.from_iterable(readings(word) for word in words))
    most = [name for name, count in found.items() if count >= MOST * len(words)]
    if not most or _are_numbers(words):
        return tuple(most)
    try:
        return (choose(words, joined=True).name,)
    except SourceError:
        return tuple(most)


def _clock_beside(column: Column, columns: Sequence[Column]) -> str:
    """Return the column with the clock, where the first has days alone and has them again."""
    if len(set(column.cells)) == len(column.cells) or any(':' in cell for cell in column.cells):
        return ''
    for other in columns:
        clocks = sum(bool(_CLOCK.fullmatch(cell)) for cell in other.cells)
        if other is not column and clocks >= MOST * len(other.cells):
            return other.name
    return ''
