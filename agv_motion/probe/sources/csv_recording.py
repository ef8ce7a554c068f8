"""The probes of a logger's files in kelvin, and the air beside them, in the order of time."""

from __future__ import annotations

from math import inf, nan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import SourceError
from agv_motion.probe.environment import Environment
from agv_motion.probe.sources.source import MOST, kelvin_per
from agv_motion.probe.tables.table import LoggerTable, LoggerTables
from agv_motion.probe.tables.time_format import iso, parse_time

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.probe.sources.csv_parameters import CsvParameters

DAY = 86400.0
ROUNDED = 1e-3
"""[s] by which a start may lie outside the file, since a time in words is rounded"""


class CsvRecording(NamedTuple):
    """What files tell, in the order of time."""

    times: list[float]
    """[s] since 1970"""
    values: NDArray[np.float64]
    """(n, probes) [K]"""
    air: list[Environment]
    """(n,) radiation and vapour pressure deficit; empty where no column tells them"""
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
    return in_kelvin(LoggerTables(parameters.table()).read(), parameters)


def in_kelvin(table: LoggerTable, given: CsvParameters) -> CsvRecording:
    """Return what a table of probes, and behind them the air, tells."""
    times, columns = table.times, table.values[:, : len(given.columns)].copy()
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
    air = _air(table.values[:, len(given.columns) :], given)
    return CsvRecording(times.tolist(), values, air, step, problem, table)


def _air(columns: NDArray[np.float64], given: CsvParameters) -> list[Environment]:
    rows = columns.tolist()
    if given.radiation_column:
        return [Environment(*row) for row in rows]
    return [Environment(vapour_pressure_deficit=row[0]) for row in rows] if given.vpd_column else []


def _shifted(
    times: NDArray[np.float64], column: NDArray[np.float64], offset: float, reach: float
) -> NDArray[np.float64]:
    """Return what a column tells ``offset`` [s] later, or at most ``reach`` [s] from that."""
    wanted = times + offset
    after = np.maximum(np.searchsorted(times, wanted), 1)
    nearest, before = np.minimum(after, len(times) - 1), after - 1
    nearest = np.where(
        np.abs(times[before] - wanted) <= np.abs(times[nearest] - wanted), before, nearest
    )
    found = np.abs(times[nearest] - wanted) <= reach
    return np.where(found, column[nearest], nan)
