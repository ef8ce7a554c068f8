"""One line of a logger into one sample, whatever brings it: a serial line or a message."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Annotated

from agv_motion.errors import SignalError
from agv_motion.parameters import Spec, check
from agv_motion.probe.environment import Environment
from agv_motion.probe.sources.checksum import Checksum, checked
from agv_motion.probe.sources.line_formats import Arrival, line_reader
from agv_motion.probe.sources.source import (
    KELVIN_PER_MILLIVOLT,
    UNITS,
    ProbeSample,
    kelvin,
    kelvin_per,
)

if TYPE_CHECKING:
    from agv_motion.probe.sources.logger_line import LoggerLine


@dataclass(frozen=True)
class LineParameters:
    """What stands in each line of a logger."""

    fields: Annotated[
        tuple[int, ...], Spec('which value of a line each probe is, counted from 1', '1', (1, 64))
    ] = (1, 2, 3)
    radiation_field: Annotated[
        int, Spec('which value is solar radiation in W/m2; 0: none', '1', (0, 64))
    ] = 0
    vpd_field: Annotated[
        int, Spec('which value is vapour pressure deficit in kPa; 0: none', '1', (0, 64))
    ] = 0
    unit: Annotated[str, Spec('of the values', choices=UNITS)] = 'mV'
    kelvin_per_millivolt: Annotated[float, Spec('of the thermocouple', 'K/mV', (0.1, 1e4))] = (
        KELVIN_PER_MILLIVOLT
    )
    utc_offset: Annotated[float, Spec('time of the logger minus UTC', 'h', (-14, 14))] = 0.0
    period: Annotated[float, Spec('usual time between lines', 's', (0.01, 3600.0))] = 30.0
    format: Annotated[
        str,
        Spec(
            'of the lines: auto (date and clock, or seconds since 1970, then values), arrival '
            '(values alone, with labels or without), campbell_comma, campbell_printable, '
            'datataker, or a regular expression with groups time and values, or v1, v2, ...'
        ),
    ] = 'auto'
    time_format: Annotated[
        str, Spec('of the group time of a regular expression, as of csv.time_format')
    ] = 'iso'
    checksum: Annotated[
        str,
        Spec(
            'behind each line as hexadecimal digits, after * or a comma',
            choices=tuple(each.value for each in Checksum),
        ),
    ] = 'none'

    def __post_init__(self) -> None:
        """Check every row.

        Raises:
            ConfigurationError: A value is not allowed, or the format is none.

        """
        check(self)
        line_reader(self.format, self.time_format)


def parse_line(text: str, parameters: LineParameters, now: float = 0.0) -> ProbeSample:
    """Return the sample of one line that arrives ``now`` [s]; a field that is no number is NaN.

    Raises:
        SignalError: The line has no one reading, or a field is missing; the line is quoted.

    """
    return sample_of(text, read_line_of(text, parameters, now), parameters)


def read_line_of(text: str, given: LineParameters, now: float) -> LoggerLine:
    """Return time and values of one line, in the units of the logger.

    Raises:
        SignalError: The line has no one reading; it is quoted.

    """
    try:
        line = checked(text, Checksum(given.checksum))
        return line_reader(given.format, given.time_format)(line, Arrival(now, given.utc_offset))
    except SignalError as error:
        msg = f"unreadable line '{text:.80}': {error}"
        raise SignalError(msg) from error


def sample_of(text: str, line: LoggerLine, parameters: LineParameters) -> ProbeSample:
    """Return what a line tells of the probes, in kelvin, and of the air.

    Raises:
        SignalError: A field is missing; the line is quoted.

    """
    last = max(*parameters.fields, parameters.radiation_field, parameters.vpd_field)
    if len(line.values) < last:
        msg = (
            f"line '{text:.80}' has {len(line.values)} values, probe field {last} is missing: "
            'check the logger, or the parameter fields of the source'
        )
        raise SignalError(msg)
    factor = kelvin_per(parameters.unit, parameters.kelvin_per_millivolt)
    told = {0: nan} | dict(enumerate(line.values, 1))
    return ProbeSample(
        line.time,
        tuple(kelvin(told[f], factor) for f in parameters.fields),
        Environment(told[parameters.radiation_field], told[parameters.vpd_field]),
    )
