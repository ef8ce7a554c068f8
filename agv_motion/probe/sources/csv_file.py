"""Recorded probes: any column and unit of a CSV file, played at any speed."""

from __future__ import annotations

import csv
from bisect import bisect_left
from dataclasses import dataclass
from datetime import datetime, timezone
from math import inf, nan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.files import text
from agv_motion.parameters import Spec, check
from agv_motion.probe.sources.source import KELVIN_PER_MILLIVOLT, MOST, UNITS, Sample, kelvin_per

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

DAY = 86400.0
EARLIEST, LATEST = 0.0, 2.0**32
"""[s] since 1970, to 2106: what a stamp of ROS can hold"""
LARGEST = 256 << 20
"""[bytes] of a recording: a year of three probes every second"""


@dataclass(frozen=True)
class CsvParameters:
    """Which file, which columns, and how fast."""

    file: Annotated[str, Spec('path of the CSV file')] = ''
    time_column: Annotated[
        str, Spec('column of ISO 8601 times (UTC unless they say otherwise) or of epoch seconds')
    ] = 'time'
    columns: Annotated[tuple[str, ...], Spec('column of each probe')] = (
        'probe_1', 'probe_2', 'probe_3',
    )  # fmt: skip
    day_offsets: Annotated[
        tuple[float, ...],
        Spec('each probe is read so many days later in the file', 'd', (-1e5, 1e5)),
    ] = (0.0, 0.0, 0.0)
    unit: Annotated[str, Spec('of the columns', choices=UNITS)] = 'mV'
    kelvin_per_millivolt: Annotated[float, Spec('of the thermocouple', 'K/mV', (0.1, 1e4))] = (
        KELVIN_PER_MILLIVOLT
    )
    start: Annotated[str, Spec('ISO 8601 time at which to start; empty: the first row')] = ''
    speed: Annotated[float, Spec('seconds of the file per second', '1', (1e-3, 1e6))] = 1.0

    def __post_init__(self) -> None:
        """Check every row, and that each probe has column and offset."""
        check(self)
        if len(self.day_offsets) != len(self.columns) or not self.columns:
            msg = (
                f'{len(self.columns)} columns and {len(self.day_offsets)} day_offsets: '
                'give one of each for every probe'
            )
            raise ConfigurationError(msg)


class CsvSource:
    """Plays a file: the first reading is due at the first call of `read`."""

    def __init__(self, parameters: CsvParameters, warm_up_days: float) -> None:
        """Load the file.

        Args:
            parameters: Which file and columns.
            warm_up_days: How much of what lies before the start to offer as history [d].

        Raises:
            SourceError: The file cannot be read, holds no row, or ends before the start.
            ConfigurationError: A column is not in the file.

        """
        self._given = parameters
        self._warm_up = warm_up_days * DAY
        self._times, self._values, self._problem = load(parameters)
        self._start = parse_time(parameters.start) if parameters.start else float(self._times[0])
        self._row = bisect_left(self._times, self._start)
        if self._row == len(self._times):
            msg = (
                f'{parameters.file} ends at {iso(self._times[-1])}, before the start '
                f"'{parameters.start}': choose an earlier one"
            )
            raise SourceError(msg)
        steps = np.diff(self._times)
        self.period = float(np.median(steps)) / parameters.speed if len(steps) else inf
        self._began: float | None = None

    def history(self, now: float) -> Iterator[Sample]:  # noqa: ARG002 - the file has its own time
        """Yield the rows before the start, as far back as the warm-up reaches."""
        first = bisect_left(self._times, self._start - self._warm_up)
        for row in range(first, self._row):
            yield self._sample(row)

    def read(self, now: float) -> list[Sample]:
        """Return the rows due since the last call."""
        if self._began is None:
            self._began = now
        time = self._start + (now - self._began) * self._given.speed
        first = self._row
        while self._row < len(self._times) and self._times[self._row] <= time:
            self._row += 1
        if first < self._row == len(self._times):
            self._problem = f'{self._given.file} has come to its end'
        return [self._sample(row) for row in range(first, self._row)]

    def complaint(self) -> str:
        """Return cells that were no numbers, and the end of the file, once each."""
        problem, self._problem = self._problem, ''
        return problem

    def close(self) -> None:
        """Hold nothing: the file was read at once."""

    def _sample(self, row: int) -> Sample:
        return Sample(self._times[row], tuple(self._values[row].tolist()))


def load(parameters: CsvParameters) -> tuple[list[float], NDArray[np.float64], str]:
    """Return times [s], values (n, probes) [K] and what was wrong with the file.

    A probe read with an offset takes the row nearest to its shifted time, and NaN where that is
    further away than half the usual step.
    """
    times, columns, problem = _read_columns(parameters)
    order = np.argsort(times, kind='stable')
    last_of_repeated = np.append(np.diff(times[order]) > 0.0, True)
    keep = order[last_of_repeated]
    if len(keep) < len(times) or not np.array_equal(order, np.arange(len(times))):
        problem = f'{problem}; rows were put into order, {len(times) - len(keep)} repeated dropped'
    times = times[keep]
    step = float(np.median(np.diff(times))) if len(times) > 1 else 1.0
    factor = kelvin_per(parameters.unit, parameters.kelvin_per_millivolt)
    values = np.empty((len(times), len(parameters.columns)))
    for i, (name, offset) in enumerate(
        zip(parameters.columns, parameters.day_offsets, strict=True)
    ):
        wanted = times + offset * DAY
        after = np.clip(np.searchsorted(times, wanted), 1, max(len(times) - 1, 1))
        nearest = np.minimum(after, len(times) - 1)
        before = np.maximum(after - 1, 0)
        nearest = np.where(
            np.abs(times[before] - wanted) <= np.abs(times[nearest] - wanted), before, nearest
        )
        found = np.abs(times[nearest] - wanted) <= step / 2.0
        values[:, i] = np.where(found, columns[name][keep][nearest], nan)
    wild = np.abs(values) > MOST / factor
    if wild.any():
        problem = f'{problem}; {wild.sum()} values of more than {MOST:g} K are no temperature'
    values = np.where(wild, nan, values) * factor
    return times.tolist(), values, problem.lstrip('; ')


def _read_columns(
    parameters: CsvParameters,
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]], str]:
    """Read the named columns; cells that are no numbers become NaN and are counted."""
    path = Path(parameters.file)
    numbered = rows_of(path)
    header = [name.strip() for name in next(numbered, (1, []))[1]]
    for name in (parameters.time_column, *parameters.columns):
        if name not in header:
            missing = f"no column '{name}'"
            has = f'{missing}: it has {", ".join(header):.200}'
            text.refuse((path, 1, 1), has, missing)
    time_index = header.index(parameters.time_column)
    found = [
        (line, row) for line, row in numbered if len(row) > time_index and row[time_index].strip()
    ]
    if not found:
        msg = f'{path} has no row with a time: give at least one'
        raise SourceError(msg)
    times = np.array([_time(row, time_index, path, line) for line, row in found])
    rows = [row for _, row in found]
    columns, unreadable = {}, 0
    for name in set(parameters.columns):
        index = header.index(name)
        numbers = [_number(row[index]) if index < len(row) else nan for row in rows]
        unreadable += sum(number is None for number in numbers)
        columns[name] = np.array([nan if n is None else n for n in numbers], dtype=float)
    return times, columns, f'{unreadable} cells of {path} are no numbers' if unreadable else ''


def rows_of(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Yield the number of the line, counted from 1, and the cells of each row that has any.

    Raises:
        SourceError: It cannot be read, or is no CSV.

    """
    try:
        content = text.read(path, 'the probe file', LARGEST)
    except ConfigurationError as error:
        raise text.as_kind(error, SourceError) from error
    reader = csv.reader(content.split('\n'))
    try:
        for row in reader:
            if row:
                yield reader.line_num, row
    except csv.Error as error:
        reason = f'no CSV: {error}'
        text.refuse((path, reader.line_num, 1), reason, reason, SourceError)


def _time(row: list[str], index: int, path: Path, line: int) -> float:
    column = sum(len(cell) + 1 for cell in row[:index]) + 1
    try:
        return parse_time(row[index])
    except SourceError as error:
        reason = 'no time: give ISO 8601 such as 2013-06-10T00:00:00Z'
        cell = str(error).partition(': ')[2]
        text.refuse((path, line, column), cell, reason, SourceError)


def _number(cell: str) -> float | None:
    """Return the number of a cell, NaN where it is empty, None where it is something else."""
    cell = cell.strip()
    if cell.lower() in {'', 'na', 'nan', 'null', '-'}:
        return nan
    try:
        number = float(cell)
    except ValueError:
        return None
    return number if abs(number) < inf else None


def parse_time(words: str, place: str = 'start') -> float:
    """Return an ISO 8601 time, or a number of seconds, in seconds since 1970.

    Raises:
        SourceError: It is neither.

    """
    word = words.strip()
    try:
        if word.replace('.', '', 1).isdecimal():
            time = float(word)
        else:
            moment = datetime.fromisoformat(word.replace('Z', '+00:00'))
            time = moment.replace(tzinfo=moment.tzinfo or timezone.utc).timestamp()
        if not EARLIEST <= time <= LATEST:
            raise ValueError(time)  # noqa: TRY301 - as unusable as the rest
    except (ValueError, OverflowError) as error:
        msg = f"{place}: '{word:.80}' is no time: give ISO 8601 such as 2013-06-10T00:00:00Z"
        raise SourceError(msg) from error
    return time


def iso(time: float) -> str:
    """Return seconds since 1970 as ISO 8601."""
    return datetime.fromtimestamp(time, timezone.utc).isoformat()
