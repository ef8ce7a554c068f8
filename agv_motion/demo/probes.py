"""Which columns of a recording the demo plays, when nobody says."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.errors import ConfigurationError
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.csv_recording import load, start_of
from agv_motion.probe.tables.inspection import inspect
from agv_motion.probe.tables.time_format import iso

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.probe.sources.csv_recording import CsvRecording

DAY = 86400.0


class Excerpt(NamedTuple):
    """Which part of a recording is played, and in what time."""

    start: str
    """ISO 8601; empty: the first stretch in which all probes are there"""
    days: float
    """how much is played [d]"""
    seconds: float
    """simulated time in which it is played [s]"""


def recorded(path: Path, columns: list[str], unit: str, excerpt: Excerpt) -> dict[str, Any]:
    """Return the parameters of `granier_probe` that play a part of a file.

    Args:
        path: The CSV file.
        columns: Of the three probes, or fewer; empty: those whose names sound like probes.
        unit: Of the columns; empty: as their names say, or mV.
        excerpt: Which part.

    Raises:
        SourceError: The file cannot be read, or the start is not in it.
        ConfigurationError: No column can be taken for a probe.

    """
    seen = inspect(str(path))
    columns = columns or seen.probes()
    if not columns:
        names = ', '.join(column.name for column in seen.columns)
        msg = f'{path} has the columns {names}: name those of the probes by --columns'
        raise ConfigurationError(msg)
    if len(seen.time_formats) != 1:
        formats = ' or '.join(seen.time_formats) or 'no format that is known'
        msg = f'the times of {path} read as {formats}: give ISO 8601, in a column named time'
        raise ConfigurationError(msg)
    chosen = (columns * 3)[:3]
    given = CsvParameters(
        file=str(path),
        time_column=seen.time_column,
        time_format=seen.time_formats[0],
        delimiter=seen.delimiter,
        columns=tuple(chosen),
        unit=unit or _unit(chosen[0]),
        day_offsets=tuple(float(i) if len(columns) < 3 else 0.0 for i in range(3)),
        start=excerpt.start,
        speed=excerpt.days * DAY / excerpt.seconds,
    )
    recording = load(given)
    if not given.start:
        given = replace(given, start=_first_complete(recording, excerpt.days))
    start_of(given.start, recording, given.file)
    values = {f'csv__{name}': value for name, value in asdict(given).items()}
    return {'source': 'csv'} | {
        name: list(value) if isinstance(value, tuple) else value for name, value in values.items()
    }


def _unit(column: str) -> str:
    """Return the unit that the name of a column ends on."""
    word = column.lower().replace('[', '_').replace(']', '').rsplit('_', 1)[-1]
    return {'uv': 'uV', 'v': 'V', 'k': 'K', 'c': 'K', 'degc': 'K'}.get(word, 'mV')


def _first_complete(recording: CsvRecording, days: float) -> str:
    """Return the first midnight from which on all probes are there, with a week before it."""
    good = np.asarray((recording.values > 1.0).all(axis=1))
    stamps = np.array(recording.times)
    step = float(np.median(np.diff(stamps))) if len(stamps) > 1 else 900.0
    midnights = np.arange(np.ceil(stamps[0] / DAY) + 1, np.floor(stamps[-1] / DAY)) * DAY
    for history in (8.0, 2.0):
        for midnight in midnights:
            inside = (stamps >= midnight - history * DAY) & (stamps < midnight + days * DAY)
            if good[inside].sum() >= 0.97 * (history + days) * DAY / step:
                return iso(float(midnight))
    return iso(float(stamps[0]))
