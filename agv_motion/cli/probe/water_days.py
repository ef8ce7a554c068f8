"""What a tree drank on each day of a file, as `agv probes --water` prints it."""

from __future__ import annotations

from datetime import datetime, timezone
from typing import TYPE_CHECKING

import typer

from agv_motion.cli.terminal import LineTable, terminal

if TYPE_CHECKING:
    from agv_motion.probe.parameters import ProbeParameters
    from agv_motion.probe.tables.description import TableDescription
    from agv_motion.probe.water import DayOfWater

CM2 = 1e-4
"""[m2]"""


def tell_water(
    found: TableDescription, factor: float, given: ProbeParameters, area: float
) -> list[DayOfWater]:
    """Print and return what a tree drank each day, by the mean of its probes.

    Args:
        found: The file.
        factor: Kelvins of one of its units.
        given: How the probes are read, and by which solar time the days are.
        area: Of the sapwood [cm2].

    """
    from agv_motion.probe.water import DAY

    days = water_days(found, factor, given, area)
    table = LineTable('day', 'litres', '95 %', 'most [l/h]', 'known')
    for day in days:
        low_high = f'{day.drunk.low:.2f} to {day.drunk.high:.2f}'
        numbers = [f'{day.drunk.value:.2f}', low_high, f'{day.highest.value:.3f}']
        date = datetime.fromtimestamp(day.day * DAY, timezone.utc)
        table.add_row(f'{date:%Y-%m-%d}', *numbers, f'{100.0 * day.known:.0f} %')
    words = f'Water through {area:g} cm2 of sapwood, calibration {given.calibration.of}'
    typer.echo(f'\n{words}, days of UTC{given.solar_offset:+.4g} h:')
    terminal().print(table)
    return days


def water_days(
    found: TableDescription, factor: float, given: ProbeParameters, area: float
) -> list[DayOfWater]:
    """Return what :func:`tell_water` prints."""
    from agv_motion.probe.probe import Probe
    from agv_motion.probe.water import WaterMeter, WaterParameters, days_of

    columns = (found.table.values * factor).tolist()
    probes = [Probe(given) for _ in found.columns]
    times = found.table.times.tolist()
    rows = [
        [probe.update(time, value) for probe, value in zip(probes, values, strict=True)]
        for time, values in zip(times, columns, strict=True)
    ]
    trunk = WaterParameters(sapwood_area=CM2 * area)
    meter = WaterMeter(trunk, given.calibration.chosen(), given.solar_offset)
    return days_of(meter, times, rows, given.solar_offset)
