"""One line of a logger into one sample, whatever brings it: a serial line or a message."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import Annotated

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.parameters import Spec, check
from agv_motion.probe.environment import Environment
from agv_motion.probe.sources.checksum import Checksum, checked
from agv_motion.probe.sources.json_line import read_json
from agv_motion.probe.sources.line_formats import Arrival, instant_of, line_reader
from agv_motion.probe.sources.line_listener import LineListener, Origin
from agv_motion.probe.sources.logger_line import LONGEST_LINE, LoggerLine
from agv_motion.probe.sources.source import (
    KELVIN_PER_MILLIVOLT,
    UNITS,
    ProbeSample,
    kelvin,
    kelvin_per,
)
from agv_motion.probe.tables.time_format import named

JSON = 'json'
"""The format that is no line of words."""


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
            'datataker, json, or a regular expression with groups time and values, or v1, v2, ...'
        ),
    ] = 'auto'
    time_format: Annotated[
        str, Spec('of the group time of a regular expression, or of JSON, as of csv.time_format')
    ] = 'iso'
    json_keys: Annotated[
        tuple[str, ...],
        Spec('members of a JSON object that are its values; within another: air.vpd, probes.0'),
    ] = ('probe_1', 'probe_2', 'probe_3')
    json_time: Annotated[
        str, Spec('member of a JSON object that is its time; empty: that of the arrival')
    ] = 'time'
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
        if self.format != JSON:
            line_reader(self.format, self.time_format)
            return
        named(self.time_format)
        last = max(*self.fields, self.radiation_field, self.vpd_field)
        if last > len(self.json_keys) or not all(self.json_keys):
            msg = f'json_keys = {list(self.json_keys)}: name a member for each field up to {last}'
            raise ConfigurationError(msg)

    @property
    def stamped(self) -> bool:
        """Whether a line tells its time; where not, that of its arrival is taken."""
        if self.format == JSON:
            return bool(self.json_time)
        if '(?P<' in self.format:
            return '(?P<time>' in self.format
        return self.format != 'arrival'


class LineReader(LineListener):
    """Turns lines into samples, and keeps what is wrong with them until it is asked."""

    def __init__(self, parameters: LineParameters, origin: Origin) -> None:
        """Have read nothing."""
        super().__init__(parameters.period, origin)
        self._given = parameters

    def line(self, text: str, now: float) -> LoggerLine | None:
        """Return what a line tells that arrives ``now`` [s]; None, and a problem, if nothing."""
        self.last = text
        try:
            line = read_line_of(text, self._given, now)
        except SignalError as error:
            self.unreadable(text, str(error))
            return None
        if line.decimal_comma:
            self.note_once('comma', f"decimal commas in '{text:.80}' are read as points: told once")
        return line

    def sample(self, text: str, line: LoggerLine) -> ProbeSample | None:
        """Return what a line tells of the probes; None, and a problem, where one is missing."""
        try:
            return sample_of(text, line, self._given)
        except SignalError as error:
            self.note(str(error))
            return None


def read_line_of(text: str, given: LineParameters, now: float) -> LoggerLine:
    """Return time and values of one line, in the units of the logger.

    Raises:
        SignalError: The line has no one reading; it is quoted.

    """
    try:
        line = _proved(text, given)
        arrival = Arrival(now, given.utc_offset)
        if given.format == JSON:
            return _of_json(line, given, arrival)
        return line_reader(given.format, given.time_format)(line, arrival)
    except SignalError as error:
        msg = f"unreadable line '{text:.80}': {error}"
        raise SignalError(msg) from error


def _proved(text: str, given: LineParameters) -> str:
    """Return the line without its checksum.

    Raises:
        SignalError: The sum is another, or it is longer than any line of a logger.

    """
    if len(text) > LONGEST_LINE and given.format != JSON:
        msg = f'it has {len(text)} letters, and no line more than {LONGEST_LINE}: check the logger'
        raise SignalError(msg)
    return checked(text, Checksum(given.checksum))


def _of_json(text: str, given: LineParameters, arrival: Arrival) -> LoggerLine:
    told = read_json(text, given.json_keys, given.json_time)
    time = arrival.now
    if given.json_time:
        time = instant_of(told.time, named(given.time_format), arrival)
    return LoggerLine(time, told.values, decimal_comma=False)


def sample_of(text: str, line: LoggerLine, parameters: LineParameters) -> ProbeSample:
    """Return what a line tells of the probes, in kelvin, and of the air; no number is NaN.

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
