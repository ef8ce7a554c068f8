"""How a table is laid out: what stands between its columns, and where each wanted one is."""

from __future__ import annotations

import csv
import re
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import ConfigurationError
from agv_motion.probe.tables.signs import DELIMITERS, JOIN

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.probe.tables.file_text import FileLine
    from agv_motion.probe.tables.table_parameters import TableParameters

HEAD = 100
"""Lines in which the header is looked for; those of a logger have four, of a portal some sixty."""

_SEPARATOR = re.compile(r'sep=(.)', re.IGNORECASE)
_BLANKS = re.compile(r'[ \t]+')


class TableForm(NamedTuple):
    """How the lines of one file are to be read."""

    delimiter: str
    header: int
    """number of the line with the names; 0 where there is none"""
    begin: int
    """number of the last line that is passed over at the head"""
    width: int
    """columns"""
    time: tuple[int, ...]
    """columns, from 0, that make the time"""
    columns: tuple[int, ...]
    """of the probes"""
    names: tuple[str, ...] = ()
    """of the columns that make the time, and of the probes; some may be numbers; none: no header"""

    def under(self, line: FileLine, comment: str) -> TableForm | None:
        """Return how it goes on under a line that is a header again; None if it is none.

        A logger writes one when its program was changed, and who joins files has one of each. A
        column that is not there any more is at -1.
        """
        times = self.names[: len(self.time)]
        if not times or times[0] not in line.text:
            return None
        cells = _names(line.text, self.delimiter, comment)
        at = [_place(name, cells) for name in self.names]
        if min(at[: len(times)]) < 0 or not _has_name(cells, times):
            return None
        same = (*self.time, *self.columns) == tuple(at)
        return self._replace(
            header=line.number,
            width=self.width if same else len(cells),
            time=tuple(at[: len(times)]),
            columns=tuple(at[len(times) :]),
        )

    def split(self, line: str) -> list[str]:
        """Return the cells of a line.

        Raises:
            csv.Error: A quotation in it does not end.

        """
        cells = split(line, self.delimiter)
        if self.delimiter == ' ' and len(cells) == self.width + 1 and len(self.time) == 1:
            day = self.time[0]  # a date and a clock under one name
            cells[day : day + 2] = [f'{cells[day]} {cells[day + 1]}']
        return cells


def split(line: str, delimiter: str) -> list[str]:
    """Return the cells of a line, without blanks around them; a quotation ends in its line.

    Raises:
        csv.Error: It does not.

    """
    if delimiter == ' ':
        line = _BLANKS.sub(' ', line.strip())
    if '"' not in line:
        return [cell.strip() for cell in line.split(delimiter)]
    strict = line.count('"') % 2 == 1  # else a blank may follow a quotation
    reader = csv.reader((line,), delimiter=delimiter, strict=strict, skipinitialspace=True)
    return [cell.strip() for cell in next(reader)]


def find_form(lines: Sequence[FileLine], given: TableParameters, path: Path) -> TableForm:
    """Return how a file is laid out.

    Args:
        lines: All of it, or its first ones.
        given: Names or numbers of the columns that are wanted, and what is known of the form.
        path: For the error.

    Raises:
        ConfigurationError: A column is not there, or twice.

    """
    begin = given.skip_lines
    head = [line for line in lines if line.number > begin][:HEAD]
    delimiters = list(DELIMITERS.values())
    if chosen := DELIMITERS.get(given.delimiter):
        delimiters = [chosen]
    elif head and (found := _SEPARATOR.fullmatch(head[0].text.strip())):
        delimiters, begin, head = [found[1]], head[0].number, head[1:]
    wanted = (*_parts(given.time_column), *given.columns)
    for whole in (True, False):  # a name may hold the sign that joins names
        names = (given.time_column, *given.columns) if whole else wanted
        times = 1 if whole else len(wanted) - len(given.columns)
        for delimiter in delimiters:
            for line in head:
                cells = _names(line.text, delimiter, given.comment)
                at = [_place(name, cells) for name in names]
                if min(at) >= 0 and _has_name(cells, names):
                    _require_once(cells, names, (path, line.number, 1))
                    return TableForm(
                        delimiter, line.number, max(begin, line.number),
                        _width(head, line, delimiter, len(cells), max(at) + 1),
                        tuple(at[:times]), tuple(at[times:]), tuple(names),
                    )  # fmt: skip
    if all(name.isdecimal() and name != '0' for name in wanted):
        return _numbered(head, delimiters, [int(name) - 1 for name in wanted], begin, given)
    raise _not_there(head, delimiters, wanted, path, given.comment)


def _width(
    head: Sequence[FileLine], header: FileLine, delimiter: str, names: int, least: int
) -> int:
    """Return how many cells a row has: as many as there are names, unless all have fewer."""
    widths = {len(_names(line.text, delimiter, '')) for line in head if line.number > header.number}
    return max(*widths, least) if widths and max(widths) < names else names


def _parts(time_column: str) -> list[str]:
    return [part.strip() for part in time_column.split(JOIN)]


def _place(name: str, cells: Sequence[str]) -> int:
    """Return where a column is, by its name or else its number; -1 if it is not there."""
    if name in cells:
        return cells.index(name)
    return int(name) - 1 if name.isdecimal() and int(name) <= len(cells) else -1


def _has_name(cells: Sequence[str], names: Sequence[str]) -> bool:
    """Tell whether a line has a name, and not only numbers that may be data."""
    return any(name in cells and not name.isdecimal() for name in names)


def _names(line: str, delimiter: str, comment: str) -> list[str]:
    """Return the names in a line, which may be marked as a comment."""
    try:
        return split(line.lstrip().removeprefix(comment), delimiter)
    except csv.Error:
        return []


def _require_once(cells: Sequence[str], names: Sequence[str], where: tuple[Path, int, int]) -> None:
    for name in names:
        if cells.count(name) > 1:
            twice = (
                f"column '{name}' is there {cells.count(name)} times: give each its own name, or "
                f'say which by its number, {cells.index(name) + 1} or another'
            )
            raise ConfigurationError.at(where, twice, twice)


def _numbered(
    head: Sequence[FileLine], delimiters: Sequence[str], at: Sequence[int], begin: int,
    given: TableParameters,
) -> TableForm:  # fmt: skip
    """Return the form by which most lines have numbers in the wanted columns."""
    times = len(at) - len(given.columns)
    best, most, width = delimiters[0], 0, max(at) + 1
    for delimiter in delimiters:
        rows = [_names(line.text, delimiter, '') for line in head]
        fits = [row for row in rows if len(row) > max(at) and _is_data(row, at, times, given)]
        if len(fits) > most:
            best, most = delimiter, len(fits)
            width = max(len(row) for row in fits)
    return TableForm(best, 0, begin, width, tuple(at[:times]), tuple(at[times:]))


def _is_data(row: Sequence[str], at: Sequence[int], times: int, given: TableParameters) -> bool:
    told = [row[i] for i in at[times:] if row[i] and row[i].lower() not in given.missing]
    clock = all(any(map(str.isdecimal, row[i])) for i in at[:times])
    return clock and bool(told) and all(map(is_number, told))


def is_number(cell: str) -> bool:
    """Tell whether a cell is a number, with point or comma."""
    try:
        float(cell.replace(',', '.', 1))
    except ValueError:
        return False
    return True


def _not_there(
    head: Sequence[FileLine],
    delimiters: Sequence[str],
    wanted: Sequence[str],
    path: Path,
    comment: str,
) -> ConfigurationError:
    """Return which column is not there, with those that are."""
    rows = [
        (len(cells), sum(name in cells for name in wanted), -line.number, cells)
        for line in head
        for delimiter in delimiters
        if (cells := _names(line.text, delimiter, comment))
    ]
    if not rows:
        empty = 'no line with any column: the file is empty'
        return ConfigurationError.at((path, 1, 1), empty, empty)
    _, _, line, cells = max(
        rows, key=lambda row: (row[1], row[0] > 1 and not is_number(row[3][-1]), row[0], row[2])
    )
    name = next(name for name in wanted if name not in cells)
    missing = f"no column '{name}'"
    has = f'{missing}: it has {", ".join(cells):.200}; or give the numbers of the columns'
    return ConfigurationError.at((path, -line, 1), has, missing)
