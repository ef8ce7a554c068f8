"""Recorded probes: any column and unit of a logger's files, played at any speed or as they grow."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import AgvMotionError
from agv_motion.probe.environment import UNKNOWN
from agv_motion.probe.sources.csv_recording import DAY, in_kelvin, load, start_of
from agv_motion.probe.sources.source import ProbeSample
from agv_motion.probe.tables.table import LoggerTables

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.probe.sources.csv_parameters import CsvParameters
    from agv_motion.probe.sources.csv_recording import CsvRecording


AHEAD = DAY
"""[s] by which a logger's clock may be ahead of the one here"""


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
        return _sample(self._recording, row)


class GrowingSource:
    """Tells what a logger adds to its files, each row once it is written."""

    def __init__(self, parameters: CsvParameters, warm_up_days: float) -> None:
        """Read what is there already, which is history: it may be of long ago.

        Raises:
            SourceError: The files cannot be read, or hold no row that can.
            ConfigurationError: A column is not in a file.

        """
        self._given, self._warm_up = parameters, warm_up_days * DAY
        self._tables = LoggerTables(parameters.table())
        self._past = in_kelvin(self._tables.read(growing=True), parameters)
        self._last = self._past.times[-1] if self._past.times else -inf
        self._problem = self._past.problem
        self.period = self._past.step

    def history(self, now: float) -> Iterator[ProbeSample]:
        """Yield the rows that were there at the start, as far back as the warm-up reaches."""
        times = self._past.times
        end = bisect_right(times, now + AHEAD)
        if 0 < end < len(times) and times[end] - times[end - 1] > AHEAD:
            self._tell_ahead(len(times) - end)
            self._last = times[end - 1]
        first = bisect_left(times, self._last - self._warm_up)
        yield from _samples(self._past, first, bisect_right(times, self._last))

    def read(self, now: float) -> list[ProbeSample]:
        """Return the rows that were added since the last call.

        A clock that was right and leaps days ahead would make all later rows old: such rows are
        left out.
        """
        try:
            new = in_kelvin(self._tables.read(growing=True), self._given)
        except (AgvMotionError, OSError) as error:
            self._problem = str(error)  # the disk of a logger comes and goes
            return []
        first = bisect_left(new.times, np.nextafter(self._last, inf))
        if first:
            late = f'{first} rows are older than what was read before: left out'
            self._problem = '; '.join(filter(None, (self._problem, late)))
        self._problem = '; '.join(filter(None, (self._problem, new.problem)))
        end = len(new.times)
        if -inf < self._last <= now + AHEAD:
            end = bisect_right(new.times, max(now, self._last) + AHEAD)
            self._tell_ahead(len(new.times) - end)
        samples = list(_samples(new, first, end))
        if samples:
            self._last = samples[-1].time
        return samples

    def _tell_ahead(self, rows: int) -> None:
        if rows:
            told = f'{rows} rows are days ahead of the clock here: left out; set the logger'
            self._problem = '; '.join(filter(None, (self._problem, told)))

    def complaint(self) -> str:
        """Return what was wrong with rows or files since the last call."""
        problem, self._problem = self._problem, ''
        return problem

    def close(self) -> None:
        """Hold nothing: each look opens and closes the files."""


def _samples(recording: CsvRecording, first: int, end: int) -> Iterator[ProbeSample]:
    for row in range(first, end):
        yield _sample(recording, row)


def _sample(recording: CsvRecording, row: int) -> ProbeSample:
    air = recording.air[row] if recording.air else UNKNOWN
    return ProbeSample(recording.times[row], tuple(recording.values[row].tolist()), air)
