"""What a file of a logger holds: rows, step, gaps, what each column may be, and how to read it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.errors import ConfigurationError
from agv_motion.probe.tables.table_parameters import TableParameters

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.probe.tables.inspection import Inspection
    from agv_motion.probe.tables.table import LoggerTable

GAP = 1.5
"""Number of usual steps; more time than that between two rows is a gap."""
MILLIVOLT, KELVIN = (0.05, 2.5), (2.5, 30.0)
"""Between the needles of a heated probe, as a thermocouple of type T tells it, and in kelvin."""
UNIT_ENDINGS = {'uv': 'uV', 'v': 'V', 'mv': 'mV', 'k': 'K', 'c': 'K', 'degc': 'K', '°c': 'K'}


class ColumnFacts(NamedTuple):
    """What a column holds."""

    name: str
    values: int
    missing: int
    low: float
    high: float
    """NaN where there is no value"""
    like: str
    """what it may be: `mV`, `K`, or empty where it is not like a probe"""


class TableDescription(NamedTuple):
    """What a file holds."""

    table: LoggerTable
    step: float
    """[s] usual time between two rows; NaN where there is one"""
    gaps: tuple[tuple[float, float], ...]
    """begin and end of each [s since 1970]"""
    columns: tuple[ColumnFacts, ...]
    """of `LoggerTable.values`"""


def describe(table: LoggerTable, names: Sequence[str]) -> TableDescription:
    """Return what is in columns of a file."""
    steps = np.diff(table.times)
    step = float(np.median(steps)) if len(steps) else float('nan')
    at = np.flatnonzero(steps > GAP * step)
    gaps = tuple((float(table.times[i]), float(table.times[i + 1])) for i in at)
    facts = tuple(_facts(name, table.values[:, i]) for i, name in enumerate(names))
    return TableDescription(table, step, gaps, facts)


def _facts(name: str, column: NDArray[np.float64]) -> ColumnFacts:
    told = column[np.isfinite(column)]
    low, high = (float(told.min()), float(told.max())) if len(told) else (np.nan, np.nan)
    return ColumnFacts(name, len(told), len(column) - len(told), low, high, _like(name, told))


def _like(name: str, told: NDArray[np.float64]) -> str:
    """Return in what unit a column may be a probe, by its name or else by what is usual in it."""
    if unit := unit_in(name):
        return unit
    usual = float(np.median(told)) if len(told) else np.nan
    if MILLIVOLT[0] <= usual < MILLIVOLT[1]:
        return 'mV'
    return 'K' if KELVIN[0] <= usual < KELVIN[1] else ''


def unit_in(name: str) -> str:
    """Return the unit on which the name of a column ends; empty where it ends on none."""
    words = name.lower().replace('[', '_').replace('(', '_').replace(' ', '_')
    _, begun, ending = words.rstrip('])').rpartition('_')
    return UNIT_ENDINGS.get(ending, '') if begun else ''


def parameters_for(
    seen: Inspection, given: dict[str, str], columns: Sequence[str]
) -> TableParameters:
    """Return the parameters that read a file.

    Args:
        seen: What its first rows show.
        given: What is known better, by the names of the parameters.
        columns: Those wanted; empty: those whose names sound like probes, or all of numbers.

    Raises:
        ConfigurationError: Its times have no reading, or several; or it has no numbers.

    """
    names = tuple(columns) or tuple(seen.probes() or seen.numbers())
    found: dict[str, Any] = {'time_column': seen.time_column, 'delimiter': seen.delimiter} | given
    if 'time_format' not in found:
        found['time_format'] = _one_format(seen)
    if not found['time_column'] or not names:
        what = 'time' if names else 'numbers'
        has = ', '.join(column.name for column in seen.columns)
        msg = f'no column of {what} is seen in {seen.files[0]}: it has {has:.300}; name them'
        raise ConfigurationError(msg)
    return TableParameters(columns=names, **found)


def _one_format(seen: Inspection) -> str:
    if len(seen.time_formats) > 1:
        word = next(c for c in seen.columns if c.name in seen.time_column).cells[0]
        readings = ' or '.join(seen.time_formats)
        msg = f"the times of {seen.files[0]} ('{word}') read as {readings}: choose by --time-format"
        raise ConfigurationError(msg)
    return seen.time_formats[0] if seen.time_formats else 'auto'


def asked_for(given: TableParameters) -> dict[str, object]:
    """Return the parameters that are not as they are by default: those that one has to write."""
    plain = TableParameters()
    names = ('file', 'time_column', 'time_format', 'time_zone', 'columns', 'delimiter', 'decimal')
    found = {name: getattr(given, name) for name in names}
    found = {name: value for name, value in found.items() if value != getattr(plain, name)}
    if found.get('time_format') == 'iso':
        del found['time_format']  # is found in any case
    if found.get('delimiter') and not _by_number(given):
        del found['delimiter']  # is found by the names
    return found


def _by_number(given: TableParameters) -> bool:
    return all(name.isdecimal() for name in given.columns)
