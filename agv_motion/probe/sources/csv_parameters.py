"""What is to be played of a logger's files, and how fast."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec
from agv_motion.probe.sources.source import KELVIN_PER_MILLIVOLT, UNITS
from agv_motion.probe.tables.table_parameters import TableParameters


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
    radiation_column: Annotated[
        str, Spec('column of solar radiation in W/m2, or its number; empty: there is none')
    ] = ''
    vpd_column: Annotated[
        str, Spec('column of vapour pressure deficit in kPa, or its number; empty: there is none')
    ] = ''
    start: Annotated[str, Spec('ISO 8601 time at which to start; empty: the first row')] = ''
    speed: Annotated[float, Spec('seconds of the file per second', '1', (1e-3, 1e6))] = 1.0
    follow: Annotated[
        bool, Spec('tell each row when a logger has written it, in place of playing the file')
    ] = False

    def table(self) -> TableParameters:
        """Return what is to be read: probes, and behind them the air where it is told."""
        told = tuple(name for name in (self.radiation_column, self.vpd_column) if name)
        values = {field.name: getattr(self, field.name) for field in fields(TableParameters)}
        return TableParameters(**values | {'columns': self.columns + told})

    def __post_init__(self) -> None:
        """Check every row, and that each probe has column and offset."""
        super().__post_init__()
        if len(self.day_offsets) != len(self.columns):
            msg = (
                f'{len(self.columns)} columns and {len(self.day_offsets)} day_offsets: '
                'give one of each for every probe'
            )
            raise ConfigurationError(msg)
        told = [name for name in (self.radiation_column, self.vpd_column) if name]
        if set(told) & set(self.columns) or len(set(told)) < len(told):
            msg = (
                f'radiation_column, vpd_column = {told} beside the probes {list(self.columns)}: '
                'give each a column of its own'
            )
            raise ConfigurationError(msg)
        if self.follow and (any(self.day_offsets) or self.start or self.speed != 1.0):
            msg = 'follow = true takes rows as they come: leave out start, speed and day_offsets'
            raise ConfigurationError(msg)
