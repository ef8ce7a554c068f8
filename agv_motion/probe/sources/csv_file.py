"""Recorded probes: any column and unit of a logger's files, played at any speed or as they grow."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from math import inf, nan
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from agv_motion.errors import AgvMotionError, ConfigurationError, SourceError
from agv_motion.parameters import Spec
from agv_motion.probe.sources.source import (
    KELVIN_PER_MILLIVOLT,
    MOST,
    UNITS,
    ProbeSample,
    kelvin_per,
)
from agv_motion.probe.tables.table import LoggerTable, LoggerTables
from agv_motion.probe.tables.table_parameters import TableParameters
from agv_motion.probe.tables.time_format import iso, parse_time

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

DAY = 86400.0
ROUNDED = 1e-3
"""[s] by which a start may lie outside the file, since a time in words is rounded"""


@dataclass(frozen=True)
class CsvParameters(TableParameters):
    """Which file, which columns, and how fast."""

    day_offsets: Annotated[
        tuple[float, ...],
        Spec(
            'days by which each probe is read later in the file',
            'd',
            (-1e5, 1e5),
        ),
    ] = (0.0, 0.0, 0.0)
    unit: Annotated[str, Spec('of the columns', choices=UNITS)] = 'mV'
    kelvin_per_millivolt: Annotated[float, Spec('of the thermocouple', 'K/mV', (0.1, 1e4))] = (
        KELVIN_PER_MILLIVOLT
    )
    start: Annotated[str, Spec('ISO 8601 time at which to start; empty: the first row')] = ''
    speed: Annotated[float, Spec('seconds of the file per second', '1', (1e-3, 1e6))] = 1.0
    follow: Annotated[
        bool, Spec('tell each row when a logger has written it, in place of playing the file')
    ] = False

    def __post_init__(self) -> None:
        """Check every row, and that each probe has column and offset."""
        super().__post_init__()
        if len(self.day_offsets) != len(self.columns):
            msg = (
                f'{len(self.columns)} columns and {len(self.day_offsets)} day_offsets: '
                'give one of each for every probe'
            )
            raise ConfigurationError(msg)
        if self.follow and (any(self.day_offsets) or self.start or self.speed != 1.0):
            msg = 'follow = true takes rows as they come: leave out start, speed and day_offsets'
            raise ConfigurationError(msg)


class CsvSource:
    """Plays a file: the first reading is due at the first call of `read`."""

    def __init__(self, parameters: CsvParameters, warm_up_days: float) -> None:
        """Load the file.

        Args:
            parameters: Which file and columns.
            warm_up_days: How much of what lies before the start to offer as history [d].

        Raises:
            SourceError: The file cannot be read, holds no row that can, or the start is not in it.
            ConfigurationError: A column is not in the file.

        """
        self._given = parameters
        self._warm_up = warm_up_days * DAY
        self._recording = recording = load(parameters)
        self._problem = recording.problem
        self._start = start_of(parameters.start, recording, parameters.file)
        self._row = bisect_left(recording.times, self._start)
        self._began: float | None = None

    @property
    def period(self) -> float:
        """Usual time between two rows, as they are played [s]."""
        return self._recording.step / self._given.speed

    def history(self, now: float) -> Iterator[ProbeSample]:  # noqa: ARG002 - the file has its own time
        """Yield the rows before the start, as far back as the warm-up reaches."""
        first = bisect_left(self._recording.times, self._start - self._warm_up)
        for row in range(first, self._row):
            yield self._sample(row)

    def read(self, now: float) -> list[ProbeSample]:
        """Return the rows due since the last call."""
        if self._began is None:
            self._began = now
        time = self._start + (now - self._began) * self._given.speed
        first, times = self._row, self._recording.times
        while self._row < len(times) and times[self._row] <= time:
            self._row += 1
        if first < self._row == len(times):
            self._problem = f'{self._given.file} has come to its end'
        return [self._sample(row) for row in range(first, self._row)]

    def complaint(self) -> str:
        """Return cells that were no numbers, and the end of the file, once each."""
        problem, self._problem = self._problem, ''
        return problem

    def close(self) -> None:
        """Hold nothing: the file was read at once."""

    def _sample(self, row: int) -> ProbeSample:
        recording = self._recording
        return ProbeSample(recording.times[row], tuple(recording.values[row].tolist()))


class GrowingSource:
    """Tells what a logger adds to its files, each row once it is written."""

    def __init__(self, parameters: CsvParameters, warm_up_days: float) -> None:
        """Read what is there already, which is history: it may be of long ago.

        Raises:
            SourceError: The files cannot be read, or hold no row that can.
            ConfigurationError: A column is not in a file.

        """
        self._given, self._warm_up = parameters, warm_up_days * DAY
        self._tables = LoggerTables(parameters)
        self._past = _in_kelvin(self._tables.read(growing=True), parameters)
        self._last = self._past.times[-1] if self._past.times else -inf
        self._problem = self._past.problem
        self.period = self._past.step

    def history(self, now: float) -> Iterator[ProbeSample]:  # noqa: ARG002 - rows have their own time
        """Yield the rows that were there at the start, as far back as the warm-up reaches."""
        first = bisect_left(self._past.times, self._last - self._warm_up)
        yield from _samples(self._past, first)

    def read(self, now: float) -> list[ProbeSample]:  # noqa: ARG002 - a row is due once it is written
        """Return the rows that were added since the last call."""
        try:
            new = _in_kelvin(self._tables.read(growing=True), self._given)
        except (AgvMotionError, OSError) as error:
            self._problem = str(error)  # the disk of a logger comes and goes
            return []
        first = bisect_left(new.times, np.nextafter(self._last, inf))
        if first:
            late = f'{first} rows are older than what was read before: left out'
            self._problem = '; '.join(filter(None, (self._problem, late)))
        self._problem = '; '.join(filter(None, (self._problem, new.problem)))
        samples = list(_samples(new, first))
        if samples:
            self._last = samples[-1].time
        return samples

    def complaint(self) -> str:
        """Return what was wrong with rows or files since the last call."""
        problem, self._problem = self._problem, ''
        return problem

    def close(self) -> None:
        """Hold nothing: each look opens and closes the files."""


class CsvRecording(NamedTuple):
    """What files tell, in the order of time."""

    times: list[float]
    """[s] since 1970"""
    values: NDArray[np.float64]
    """(n, probes) [K]"""
    step: float
    """[s] usual time between rows; infinite where there is one"""
    problem: str
    """what was wrong with the files; empty if nothing"""
    table: LoggerTable
    """as it was read"""


def start_of(start: str, recording: CsvRecording, file: str) -> float:
    """Return where to start [s since 1970]: at a time in words, or at the first row.

    Raises:
        SourceError: It is no time, or not in the file.

    """
    times = recording.times
    if not start:
        return times[0]
    time = parse_time(start)
    for row, outside, when in (
        (0, time < times[0] - ROUNDED, 'begins'),
        (-1, time > times[-1] + ROUNDED, 'ends'),
    ):
        if outside:
            side = 'after' if when == 'begins' else 'before'
            msg = (
                f'{file} {when} at {iso(times[row])} ({recording.table.place(row)}), {side} the '
                f"start '{start}': choose one from {iso(times[0])} to {iso(times[-1])}"
            )
            raise SourceError(msg)
    return min(max(time, times[0]), times[-1])


def load(parameters: CsvParameters) -> CsvRecording:
    """Return what files tell.

    A probe read with an offset takes the row nearest to its shifted time, and NaN where that is
    further away than half the usual step.
    """
    return _in_kelvin(LoggerTables(parameters).read(), parameters)


def _in_kelvin(table: LoggerTable, given: CsvParameters) -> CsvRecording:
    times, columns = table.times, table.values.copy()
    step = float(np.median(np.diff(times))) if len(times) > 1 else inf
    for i, offset in enumerate(given.day_offsets):
        if offset:
            reach = step / 2.0 if len(times) > 1 else 0.5
            columns[:, i] = _shifted(times, columns[:, i], offset * DAY, reach)
    factor = kelvin_per(given.unit, given.kelvin_per_millivolt)
    wild = np.abs(columns) > MOST / factor
    problem = table.problem
    if wild.any():
        told = f'{wild.sum()} values of more than {MOST:g} K are no temperature'
        problem = '; '.join(filter(None, (problem, told)))
    values = np.where(wild, nan, columns) * factor
    return CsvRecording(times.tolist(), values, step, problem, table)


def _shifted(
    times: NDArray[np.float64], column: NDArray[np.float64], offset: float, reach: float
) -> NDArray[np.float64]:
    """Return what a column tells ``offset`` [s] later, or at most ``reach`` [s] from that."""
    wanted = times + offset
    after = np.clip(np.searchsorted(times, wanted), 1, max(len(times) - 1, 1))
    nearest = np.minimum(after, len(times) - 1)
    before = np.maximum(after - 1, 0)
    nearest = np.where(
        np.abs(times[before] - wanted) <= np.abs(times[nearest] - wanted), before, nearest
    )
    found = np.abs(times[nearest] - wanted) <= reach
    return np.where(found, column[nearest], nan)


def _samples(recording: CsvRecording, first: int) -> Iterator[ProbeSample]:
    for row in range(first, len(recording.times)):
        yield ProbeSample(recording.times[row], tuple(recording.values[row].tolist()))
