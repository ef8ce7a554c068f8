"""The rows of a table: each has its cells and the word of its time, or is left out."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.tables.file_text import FileLine
    from agv_motion.probe.tables.left_out import LeftOut
    from agv_motion.probe.tables.table_form import TableForm

UNIT_ROWS = 3
"""Rows under the names that may tell units and kinds of values, as a Campbell logger's do"""
CAMPBELL = '"TOA5"', '"TOACI1"'
"""With which the head of such a file begins"""


ENOUGH = 3
"""Rows by which it is known how long a cell is"""


class Row(NamedTuple):
    """A row as it is written."""

    line: int
    """of the file, counted from 1"""
    cells: list[str]
    """under the first header of the file, wherever they are under a later one"""
    word: str
    """of its time, which may be several cells"""


class TableRows:
    """Reads rows under a header, and under each that comes later in the same file."""

    def __init__(self, form: TableForm, comment: str) -> None:
        """Begin under the first header.

        Args:
            form: Of the file, by that header.
            comment: What a line of comment begins with.

        """
        self._first = self._form = form
        self._comment = comment
        self._fault = ''
        """why rows under the last header cannot be read"""
        self._begun = False

    def read(self, lines: Sequence[FileLine], left_out: LeftOut) -> list[Row]:
        """Return the rows that have as many cells as their header; note the others."""
        rows: list[Row] = []
        for line in lines:
            if line.number > self._first.begin and not self._is_head(line):
                row = self._row(line, left_out)
                if row is not None:
                    rows.append(row)
                    self._begun = True
        return rows

    def _is_head(self, line: FileLine) -> bool:
        """Tell whether a line is a comment or a header; one that comes again counts from here."""
        form = self._form.under(line, self._comment)
        if form is not None:
            self._form, self._begun = form, False
            places = zip(form.names, (*form.time, *form.columns), strict=True)
            gone = [name for name, at in places if at < 0]
            self._fault = f'no column {gone} under the header in line {line.number}' if gone else ''
            return True
        if self._form.header and line.text.startswith(CAMPBELL):
            self._fault = f'under the head in line {line.number} the names are others'
            return True
        return bool(self._comment) and line.text.startswith(self._comment)

    def _row(self, line: FileLine, left_out: LeftOut) -> Row | None:
        try:
            cells = self._form.split(line.text)
        except csv.Error as error:
            left_out.add(line.number, 1, f'no CSV: {error}')
            return None
        if not any(cells) and not line.fault:
            return None
        if fault := line.fault or self._fault or _misfit(cells, self._form.width):
            left_out.add(line.number, 1, fault)
            return None
        cells = self._as_at_first(cells)
        time = self._first.time
        word = cells[time[0]] if len(time) == 1 else ' '.join(cells[i] for i in time)
        if '  ' in word:
            word = ' '.join(word.split())
        told = any(map(str.isdecimal, word))
        header = self._form.header
        if told or self._begun or not header or line.number > header + UNIT_ROWS:
            return Row(line.number, cells, word)
        return None

    def _as_at_first(self, cells: list[str]) -> list[str]:
        """Return the cells that are wanted where they were under the first header."""
        first, now = self._first, self._form
        if (now.time, now.columns) == (first.time, first.columns):
            return cells
        moved = [''] * first.width
        places = (*first.time, *first.columns), (*now.time, *now.columns)
        for to, at in zip(*places, strict=True):
            moved[to] = cells[at]
        return moved


def without_cut_end(
    rows: list[Row], columns: Sequence[int], last: FileLine, left_out: LeftOut
) -> list[Row]:
    """Return rows without the last one if its last cell seems to be cut: 0.4 of 0.43.

    Args:
        rows: Of a file.
        columns: That are wanted.
        last: Its last line, which has no end; many files end so, and so do half written ones.
        left_out: Notes it.

    """
    if len(rows) < ENOUGH or rows[-1].line != last.number or len(rows[-1].cells) - 1 not in columns:
        return rows
    length = len(rows[-1].cells[-1])
    if 0 < length < min(len(row.cells[-1]) or length + 1 for row in rows[:-1]):
        left_out.add(last.number, 1, 'it has no end, and its last cell is shorter than all others')
        return rows[:-1]
    return rows


def _misfit(cells: Sequence[str], count: int) -> str:
    """Return why a row does not fit under a header of ``count`` columns; empty if it does."""
    if len(cells) < count:
        return f'{len(cells)} cells under {count} columns: it is cut short'
    if any(cells[count:]):
        return (
            f'{len(cells)} cells under {count} columns: a comma in it may be decimal, or a column '
            'has no name'
        )
    return ''
