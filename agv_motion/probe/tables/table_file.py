"""One file of a logger, read as far as it is written, and further when more has been."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.files import text
from agv_motion.probe.tables import file_text
from agv_motion.probe.tables.cell_numbers import CellNumbers
from agv_motion.probe.tables.clock_resets import REASON, after_reset
from agv_motion.probe.tables.left_out import LeftOut
from agv_motion.probe.tables.local_time import DoubledHour, LocalClock, zone_of
from agv_motion.probe.tables.table_form import find_form
from agv_motion.probe.tables.table_rows import TableRows, without_cut_end
from agv_motion.probe.tables.time_format import choose, named, second_reading, without_clock

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.probe.tables.file_text import FileLine
    from agv_motion.probe.tables.table_form import TableForm
    from agv_motion.probe.tables.table_parameters import TableParameters
    from agv_motion.probe.tables.table_rows import Row
    from agv_motion.probe.tables.time_format import TimeFormat
    from agv_motion.probe.tables.time_readers import Instant

LARGEST = 128 << 20
"""[bytes] of a recording: a year of three probes every ten seconds, which takes 3 GB to read"""


CELLS = 1 << 16
"""Different ones that are remembered"""
TAIL = 64
"""[bytes] by which a file is known again that has grown"""


class FileRows(NamedTuple):
    """Rows that can be read, in the order of the file."""

    times: NDArray[np.float64]
    """[s] since 1970, UTC"""
    lines: NDArray[np.int64]
    """of the file, counted from 1, from which each row comes"""
    values: NDArray[np.float64]
    """(n, columns); NaN where a cell is empty, stands for no value, or is no number"""
    problem: str
    """what was wrong; empty if nothing"""


class FileForm(NamedTuple):
    """How one file is written, found out from its first rows."""

    table: TableForm
    time: TimeFormat
    numbers: CellNumbers


class TableFile:
    """Knows how a file is written, and how much of it has been read."""

    def __init__(self, path: Path, given: TableParameters) -> None:
        """Read nothing yet.

        Args:
            path: The file.
            given: What is known of it.

        """
        self.path, self._given = path, given
        self.bytes_read, self._line, self._encoding = 0, 1, ''
        self._tail = b''
        self.form: FileForm | None = None
        self._rows: TableRows | None = None
        self._clock = LocalClock(zone_of(given.time_zone), DoubledHour(given.doubled_hour))

    def read(self, *, growing: bool = False) -> FileRows:
        """Return the rows that were not read before.

        Args:
            growing: Whether a logger may be writing: its last line is left until it has its end.

        Raises:
            SourceError: The file cannot be read, no row can, or its times have two readings.
            ConfigurationError: A column is not in the file, or twice.

        """
        (lines, ended), left_out = self._lines(growing=growing), LeftOut(self.path)
        if growing and not lines:
            return _nothing(len(self._given.columns))
        form = self.form.table if self.form else find_form(lines, self._given, self.path)
        self._rows = self._rows or TableRows(form, self._given.comment)
        rows = self._rows.read(lines, left_out)
        if not ended:
            rows = without_cut_end(rows, form.columns, lines[-1], left_out)
        lines.clear()  # of a large file half the memory
        if self.form is None:
            self.form = FileForm(form, self._time_format(rows, form), self._numbers(rows, form))
        instants, kept = _without_resets(*_timed(rows, self.form, left_out), left_out)
        if not kept and not growing:
            raise left_out.error()
        self._require_one_reading(instants, kept)
        times = self._in_utc(instants, kept)
        number = lru_cache(CELLS)(self.form.numbers.number)  # a logger's digits are few
        values = [number(row.cells[i]) for row in kept for i in form.columns]
        unreadable = values.count(None)
        told = f'{unreadable} cells of {self.path} are no numbers' if unreadable else ''
        return FileRows(
            np.array(times, float),
            np.array([row.line for row in kept], np.int64),
            np.array(values, float).reshape(-1, len(form.columns)),  # None becomes NaN
            '; '.join(filter(None, (left_out.told(), told))),
        )

    def is_as_read(self) -> bool:
        """Tell whether what was read last still stands there: else another file has its name."""
        begin = self.bytes_read - len(self._tail)
        return self._bytes(begin)[: len(self._tail)] == self._tail

    def _bytes(self, begin: int) -> bytes:
        try:
            return text.read_bytes(self.path, 'the probe file', LARGEST, begin)
        except ConfigurationError as error:
            raise text.as_kind(error, SourceError) from error

    def _lines(self, *, growing: bool) -> tuple[list[FileLine], bool]:
        """Return the lines that were not read before, and whether the last has its end."""
        data = self._bytes(self.bytes_read)
        if not self._encoding:
            known = data[: data.rfind(b'\n') + 1] or data  # a letter at the end may be half written
            self._encoding = file_text.encoding_of(known, self._given.encoding, str(self.path))
            head = data[: file_text.LOOKED_AT]
            file_text.require_text(head, head.decode(self._encoding, 'replace'), str(self.path))
        if growing:
            data = file_text.whole_lines(data, self._encoding)
        self.bytes_read += len(data)
        self._tail = data[-TAIL:] or self._tail
        content = data.decode(self._encoding, errors='replace')
        ended = not content or content[-1] in '\r\n\0'
        ends = content.count('\n') + content.count('\r') - content.count('\r\n')
        first, self._line = self._line, self._line + ends
        return file_text.lines_of(content, first), ended

    def _time_format(self, rows: Sequence[Row], form: TableForm) -> TimeFormat:
        if self._given.time_format != 'auto':
            return named(self._given.time_format)
        try:
            return choose([row.word for row in rows], joined=len(form.time) > 1)
        except SourceError as error:
            raise self._error(rows[0], str(error), error.unquoted) from error

    def _numbers(self, rows: Sequence[Row], form: TableForm) -> CellNumbers:
        cells = (row.cells[i] for row in rows for i in form.columns)
        try:
            return CellNumbers.of(cells, self._given)
        except SourceError as error:
            raise self._error(
                rows[0], str(error), 'its commas may be decimal or between thousands'
            ) from error

    def _require_one_reading(self, instants: Sequence[Instant], rows: Sequence[Row]) -> None:
        words, times = [row.word for row in rows], [instant.seconds for instant in instants]
        other = without_clock(words, times) if rows else ''
        if self._given.time_format == 'auto' and rows:
            other = other or second_reading(words)
        if other:
            column = f"column '{self._given.time_column}' may be {other}"
            raise self._error(rows[0], column, f'the times may be {other}')

    def _in_utc(self, instants: Sequence[Instant], rows: Sequence[Row]) -> list[float]:
        """Return the times in UTC [s since 1970]."""
        order = _as_written(instants)
        times: list[float] = []
        try:
            times.extend(map(self._clock.utc, instants[order]))
        except SourceError as error:
            raise self._error(rows[order][len(times)], str(error), str(error)) from error
        return times[order]

    def _error(self, row: Row, reason: str, unquoted: str) -> SourceError:
        return SourceError.at((self.path, row.line, 1), reason, unquoted)


def _nothing(columns: int) -> FileRows:
    return FileRows(np.empty(0), np.empty(0, np.int64), np.empty((0, columns)), '')


def _as_written(instants: Sequence[Instant]) -> slice:
    """Return the order in which rows were written: a file may have its newest row on top."""
    falls = sum(b.seconds < a.seconds for a, b in pairwise(instants))
    return slice(None, None, -1 if falls > len(instants) / 2 else 1)


def _without_resets(
    instants: list[Instant], rows: list[Row], left_out: LeftOut
) -> tuple[list[Instant], list[Row]]:
    """Return the rows whose clock was set; note the others."""
    order = _as_written(instants)
    lost = after_reset([instant.seconds for instant in instants[order]])[order]
    for row, is_lost in zip(rows, lost, strict=True):
        if is_lost:
            left_out.add(row.line, 1, REASON)
    kept = [i for i, is_lost in enumerate(lost) if not is_lost]
    return [instants[i] for i in kept], [rows[i] for i in kept]


def _timed(
    rows: Sequence[Row], form: FileForm, left_out: LeftOut
) -> tuple[list[Instant], list[Row]]:
    """Return the times of the rows that have one, and those rows; note the others."""
    instants, kept, instant_of = [], [], form.time.instant
    for row in rows:
        before = row.cells[: form.table.time[0]]
        try:
            instants.append(instant_of(row.word))
        except SourceError as error:
            column = sum(len(cell) + 1 for cell in before) + 1
            left_out.add(row.line, column, str(error), error.unquoted)
        else:
            kept.append(row)
    return instants, kept
