"""Recorded probes: any column and unit of a CSV file, played at any speed."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from math import inf, nan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.parameters import Spec, check
from agv_motion.probe.sources.csv_table import read_table
from agv_motion.probe.sources.recorded_time import iso, parse_time
from agv_motion.probe.sources.source import (
    KELVIN_PER_MILLIVOLT,
    MOST,
    UNITS,
    ProbeSample,
    kelvin_per,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

DAY = 86400.0
ROUNDED = 1e-3
"""[s] by which a start may lie outside the file, since a time in words is rounded"""


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
            SourceError: The file cannot be read, holds no row that can, or the start is not in it.
            ConfigurationError: A column is not in the file.

        """
        self._given = parameters
        self._warm_up = warm_up_days * DAY
        recording = load(parameters)
        self._times, self._values = recording.times, recording.values
        self._problem = recording.problem
        self._start = start_of(parameters.start, recording, parameters.file)
        self._row = bisect_left(self._times, self._start)
        steps = np.diff(self._times)
        self.period = float(np.median(steps)) / parameters.speed if len(steps) else inf
        self._began: float | None = None

    def history(self, now: float) -> Iterator[ProbeSample]:  # noqa: ARG002 - the file has its own time
        """Yield the rows before the start, as far back as the warm-up reaches."""
        first = bisect_left(self._times, self._start - self._warm_up)
        for row in range(first, self._row):
            yield self._sample(row)

    def read(self, now: float) -> list[ProbeSample]:
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

    def _sample(self, row: int) -> ProbeSample:
        return ProbeSample(self._times[row], tuple(self._values[row].tolist()))


class CsvRecording(NamedTuple):
    """What a file tells, in the order of time."""

    times: list[float]
    """[s] since 1970"""
    lines: list[int]
    """of the file, counted from 1, from which each comes"""
    values: NDArray[np.float64]
    """(n, probes) [K]"""
    problem: str
    """what was wrong with the file; empty if nothing"""


def start_of(start: str, recording: CsvRecording, file: str) -> float:
    """Return where to start [s since 1970]: at a time in words, or at the first row.

    Raises:
        SourceError: It is no time, or not in the file.

    """
    times, lines = recording.times, recording.lines
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
                f'{file} {when} at {iso(times[row])} (line {lines[row]}), {side} the start '
                f"'{start}': choose one from {iso(times[0])} to {iso(times[-1])}"
            )
            raise SourceError(msg)
    return min(max(time, times[0]), times[-1])


def load(parameters: CsvParameters) -> CsvRecording:
    """Return what a file tells.

    A probe read with an offset takes the row nearest to its shifted time, and NaN where that is
    further away than half the usual step.
    """
    path = Path(parameters.file)
    times, lines, columns, problem = read_table(path, parameters.time_column, parameters.columns)
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
    return CsvRecording(times.tolist(), lines[keep].tolist(), values, problem.lstrip('; '))
