"""What may be said of a file of a logger; all but the columns is found out where it is not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.probe.tables.local_time import DoubledHour, zone_of
from agv_motion.probe.tables.signs import DECIMALS, DELIMITERS
from agv_motion.probe.tables.time_format import named

ENCODINGS = 'auto', 'utf-8', 'utf-16', 'latin-1'


@dataclass(frozen=True)
class TableParameters:
    """Which file, and how it is to be read."""

    file: Annotated[
        str, Spec('path of the CSV file; or a folder of them, or a pattern such as logs/oak_*.dat')
    ] = ''
    time_column: Annotated[
        str,
        Spec("column of times, or several: 'date + clock', 'year + day + hhmm'; or its number"),
    ] = 'time'
    time_format: Annotated[
        str,
        Spec(
            'auto (ISO 8601, seconds since 1970, and days first or last where the file proves it), '
            'iso, day_first, month_first, named_month, YYYYMMDD, YYYYMMDDHHMM, YYYYMMDDHHMMSS, '
            'epoch_s, epoch_ms, epoch_us, epoch_ns, excel, excel_1904, matlab, year_day, fields, '
            'or a pattern such as %d.%m.%Y %H:%M'
        ),
    ] = 'auto'
    time_zone: Annotated[
        str, Spec('of times that tell none: UTC, UTC+1, or a name such as Europe/Zurich')
    ] = 'UTC'
    doubled_hour: Annotated[
        str,
        Spec(
            'what the hour means that the clock shows twice in autumn',
            choices=tuple(each.value for each in DoubledHour),
        ),
    ] = 'in_order'
    columns: Annotated[
        tuple[str, ...], Spec('column of each probe, or its number, counted from 1')
    ] = ('probe_1', 'probe_2', 'probe_3')
    encoding: Annotated[str, Spec('of the text', choices=ENCODINGS)] = 'auto'
    delimiter: Annotated[str, Spec('between the columns', choices=('auto', *DELIMITERS))] = 'auto'
    decimal: Annotated[str, Spec('sign of decimals', choices=('auto', *DECIMALS))] = 'auto'
    skip_lines: Annotated[
        int, Spec('lines to pass over at the head, beside those that are found', '1', (0, 10_000))
    ] = 0
    comment: Annotated[str, Spec('what a line of comment begins with; empty: none is')] = '#'
    missing: Annotated[
        tuple[str, ...], Spec('what stands for no value, in capitals or not, beside an empty cell')
    ] = (
        'na', 'n/a', 'nan', 'null', 'none', '-', '--', '---', '#n/a', '#value!', '#div/0!',
        '-6999', '-7999', '-9999', '-99999', '6999', '7999',
    )  # fmt: skip

    def __post_init__(self) -> None:
        """Check every row.

        Raises:
            ConfigurationError: A value is not allowed, or names no format or zone.

        """
        check(self)
        if self.time_format != 'auto':
            named(self.time_format)
        zone_of(self.time_zone)
        if not self.columns:
            msg = 'columns = []: give the column of each probe'
            raise ConfigurationError(msg)
