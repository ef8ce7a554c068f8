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


class Row(NamedTuple):
    """A row as it is written."""

    line: int
    """of the file, counted from 1"""
    cells: list[str]
    word: str
    """of its time, which may be several cells"""


def rows_of(
    lines: Sequence[FileLine], form: TableForm, comment: str, left_out: LeftOut
) -> list[Row]:
    """Return the rows under the header that have as many cells as it has; note the others."""
    rows: list[Row] = []
    for line in lines:
        if line.number <= form.begin or (comment and line.text.startswith(comment)):
            continue
        try:
            cells = form.split(line.text)
        except csv.Error as error:
            left_out.add(line.number, 1, f'no CSV: {error}')
            continue
        if not any(cells) and not line.fault:
            continue
        if fault := line.fault or _misfit(cells, form.width):
            left_out.add(line.number, 1, fault)
            continue
        word = cells[form.time[0]] if len(form.time) == 1 else ' '.join(cells[i] for i in form.time)
        if '  ' in word:
            word = ' '.join(word.split())
        told = any(map(str.isdecimal, word))
        if told or rows or not form.header or line.number > form.header + UNIT_ROWS:
            rows.append(Row(line.number, cells, word))
    return rows


def _misfit(cells: Sequence[str], count: int) -> str:
    """Return why a row does not fit under a header of ``count`` columns; empty if it does."""
    if len(cells) < count:
        return f'{len(cells)} cells under {count} columns: it is cut short'
    if any(cells[count:]):
        return f'{len(cells)} cells under {count} columns: a comma in it may be decimal'
    return ''
