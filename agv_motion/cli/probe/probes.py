"""`agv probes`: what is in the file of a logger, and the parameters that read it."""

from __future__ import annotations

import math
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.terminal import LineTable, terminal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.parameters import ProbeParameters
    from agv_motion.probe.tables.description import TableDescription
    from agv_motion.probe.tables.inspection import Inspection
    from agv_motion.probe.tables.table_parameters import TableParameters
    from agv_motion.probe.water import DayOfWater

MOST_GAPS = 3
"""Gaps that are told, the longest first."""


def probes(
    file: Annotated[str, typer.Argument(help='File of a logger, folder of them, or a pattern.')],
    *,
    columns: Annotated[
        str, typer.Option(help='Columns of the probes, with commas between; or their numbers.')
    ] = '',
    time_column: Annotated[str, typer.Option(help="Column of times, or 'date + clock'.")] = '',
    time_format: Annotated[str, typer.Option(help='As csv.time_format; else what is seen.')] = '',
    time_zone: Annotated[str, typer.Option(help='As csv.time_zone.')] = 'UTC',
    unit: Annotated[str, typer.Option(help='Of the probes: mV, K, V, uV; else as it seems.')] = '',
    kelvin_per_millivolt: Annotated[float, typer.Option(help='Of the thermocouple.')] = 25.0,
    plot: Annotated[Path | None, typer.Option(help='Picture to draw of what is known.')] = None,
    to: Annotated[Path | None, typer.Option(help='File to write, in the plainest form.')] = None,
    water: Annotated[
        float, typer.Option(help='Sapwood area [cm2]: tell litres, with a 95 % interval.', min=0)
    ] = 0.0,
    species: Annotated[
        str, typer.Option(help='Calibration of the flux, as probe.calibration.of.')
    ] = 'granier',
    longitude: Annotated[
        float | None,
        typer.Option(help='Degrees east, for its days; else by --time-zone.', min=-180, max=180),
    ] = None,
    dark: Annotated[bool, typer.Option('--dark', help='Picture light on dark.')] = False,
) -> None:
    """Look at any file of a logger, say what is in it, and print the parameters that read it.

    For example:

    agv probes oak.dat

    agv probes oak.csv --time-format day_first --columns dT_1,dT_2 --plot oak.png

    agv probes 'logs/*.dat' --to probes.csv
    """
    from agv_motion.cli.probe.water_days import tell_water
    from agv_motion.probe.sources.source import kelvin_per
    from agv_motion.probe.tables.description import describe, parameters_for
    from agv_motion.probe.tables.inspection import inspect
    from agv_motion.probe.tables.table import read_tables

    seen = inspect(file)
    _tell_form(seen)
    known = {'file': file, 'time_zone': time_zone}
    asked = (('time_column', time_column), ('time_format', time_format))
    known |= {name: value for name, value in asked if value}
    names = [name.strip() for name in columns.split(',') if name.strip()]
    given = parameters_for(seen, known, names)
    found = describe(read_tables(given), given.columns)
    _tell_rows(found)
    _tell_columns(found, seen, given)
    unit = unit or next((facts.like for facts in found.columns if facts.like), 'mV')
    read = _read_as(given, longitude, species, float(found.table.times[0]))
    _tell_parameters(given, unit, read.solar_offset)
    if to is not None:
        _write(found, to)
    factor = kelvin_per(unit, kelvin_per_millivolt)
    days = tell_water(found, factor, read, water) if water else None
    if plot is not None:
        _draw(found, factor, read, days, plot, 'dark' if dark else 'light')


def _read_as(
    given: TableParameters, longitude: float | None, species: str, first: float
) -> ProbeParameters:
    """Return how the probes of a file are read whose ``first`` row is at that time [s]."""
    from agv_motion.probe.calibration import CalibrationParameters
    from agv_motion.probe.parameters import ProbeParameters
    from agv_motion.probe.tables.local_time import solar_offset

    offset = solar_offset(given.time_zone, first) if longitude is None else longitude / 15.0
    return ProbeParameters(solar_offset=offset, calibration=CalibrationParameters(of=species))


def _tell_form(seen: Inspection) -> None:
    more = f' and {len(seen.files) - 1} more' if len(seen.files) > 1 else ''
    names = f'names in line {seen.header}' if seen.header else 'no names: columns by number'
    typer.echo(f'{seen.files[0]}{more}: {seen.encoding}, {seen.delimiter}, {names}')
    formats = ' or '.join(seen.time_formats) or 'none that is known'
    typer.echo(f"time: column '{seen.time_column}', format {formats}")


def _tell_rows(found: TableDescription) -> None:
    times = found.table.times
    every = '' if math.isnan(found.step) else f', every {_span(found.step)}'
    typer.echo(f'rows: {len(times)}{every}, from {_moment(times[0])} to {_moment(times[-1])}')
    for begin, end in sorted(found.gaps, key=lambda gap: gap[0] - gap[1])[:MOST_GAPS]:
        typer.echo(f'gap: {_span(end - begin)} after {_moment(begin)}')
    if len(found.gaps) > MOST_GAPS:
        typer.echo(f'gaps: {len(found.gaps)} in all')
    if found.table.problem:
        typer.echo(f'fault: {found.table.problem}')


def _tell_columns(found: TableDescription, seen: Inspection, given: TableParameters) -> None:

    table = LineTable('column', 'values', 'missing', 'lowest', 'highest', 'like')
    for facts in found.columns:
        numbers = [f'{facts.values}', f'{facts.missing}', f'{facts.low:g}', f'{facts.high:g}']
        table.add_row(facts.name, *numbers, f'probe [{facts.like}]' if facts.like else '')
    terminal().print(table)
    others = [c.name for c in seen.columns if c.name not in {*given.columns, given.time_column}]
    if others:
        typer.echo(f'other columns: {", ".join(others)}')


def _tell_parameters(given: TableParameters, unit: str, offset: float) -> None:
    from agv_motion.probe.tables.description import asked_for

    typer.echo('\ngranier_probe:\n  ros__parameters:\n    source: csv')
    count = len(given.columns)
    values = asked_for(given) | {'unit': unit}
    if count != len(type(given)().columns):
        values['day_offsets'] = (0.0,) * count
    if count < len(type(given)().columns):
        names = [f'probe_{min(i + 1, count)}' for i in range(3)]
        typer.echo(f'    assign: {_yaml(names)}  # s1 speed, s2 rotation, s3 places')
    if offset:
        typer.echo(f'    probe: {{solar_offset: {offset:.4g}}}')
    typer.echo('    csv:')
    for name, value in values.items():
        told = list(value) if isinstance(value, tuple) else value
        typer.echo(f'      {name}: {_yaml(told)}')


def _yaml(value: object) -> str:
    from json import dumps

    return dumps(value, ensure_ascii=False)


def _write(found: TableDescription, to: Path) -> None:
    """Write times in ISO 8601 and the columns as they are; never over another file."""
    from agv_motion.errors import ConfigurationError
    from agv_motion.files.unfinished import replacing

    if to.exists():
        msg = f'{to} is there already: choose another name for --to'
        raise ConfigurationError(msg)
    rows = zip(found.table.times.tolist(), found.table.values.tolist(), strict=True)
    with replacing(to) as made, made.open('w', encoding='utf-8') as file:
        file.write(','.join(['time', *(facts.name for facts in found.columns)]) + '\n')
        for time, values in rows:
            cells = ['' if math.isnan(value) else repr(value) for value in values]
            file.write(','.join([_moment(time), *cells]) + '\n')
    typer.echo(f'\nWritten: {to}')


def _draw(  # noqa: PLR0917 - a picture, and all that is drawn in it
    found: TableDescription, factor: float, read: ProbeParameters,
    days: Sequence[DayOfWater] | None, path: Path, theme: str,
) -> None:  # fmt: skip
    from agv_motion.probe.series import read_series
    from agv_motion.report.probes_figure import PlaceDays, draw, finding

    names = [facts.name for facts in found.columns]
    columns = found.table.values.T * factor
    series = [read_series(found.table.times, column, read) for column in columns]
    water = None if days is None else PlaceDays(days, read.solar_offset)
    draw(names, series, path, theme, water)
    typer.echo(f'\n{finding(names, series)}\nFigure: {path}')


def _moment(time: float) -> str:
    moment = datetime.fromtimestamp(time, timezone.utc)
    return moment.isoformat(timespec='auto').replace('+00:00', 'Z')


def _span(seconds: float) -> str:
    for size, name in ((86400.0, 'd'), (3600.0, 'h'), (60.0, 'min')):
        if seconds >= size:
            return f'{seconds / size:.4g} {name}'
    return f'{seconds:.4g} s'
