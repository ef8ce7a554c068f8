"""Probes on a serial line: ``DD-MM-YY HH:MM:SS v1 v2 v3 ...``, one line a reading.

What else loggers write is in :mod:`logger_line`. A line that cannot be read is told, a line that
goes away is opened again.
"""

from __future__ import annotations

import re
import time as wall
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import serial

from agv_motion.errors import SignalError
from agv_motion.parameters import Spec, check
from agv_motion.probe.sources.checksum import Checksum, checked
from agv_motion.probe.sources.line_formats import Arrival, line_reader
from agv_motion.probe.sources.logger_line import EPOCHS, LoggerLine, cleaned
from agv_motion.probe.sources.source import (
    KELVIN_PER_MILLIVOLT,
    UNITS,
    ProbeSample,
    kelvin,
    kelvin_per,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

LONGEST_LINE = 1024
"""[bytes] Anything longer without a line end is rubbish and dropped."""

OFF_CLOCK = 86400.0
"""[s] A logger whose clock differs from the node's by more has the wrong day, or month."""

MOST_TOLD = 3
"""Problems in one complaint; the others are counted."""

SILENT = 3.0
"""Usual times between lines after which silence is told."""

GARBAGE = 0.3
"""Share of a line that is no letter, from which on the speed of the line may be another."""

LONGEST_PAUSE = 30.0
"""[s] Between two attempts to open a line that is gone; the first comes after one second."""


@dataclass(frozen=True)
class SerialParameters:
    """The line and what stands in it."""

    port: Annotated[str, Spec('device of the logger')] = '/dev/ttyUSB0'
    baud: Annotated[int, Spec('speed of the line', 'baud', (300, 4_000_000))] = 38400
    fields: Annotated[
        tuple[int, ...], Spec('which value of a line each probe is, counted from 1', '1', (1, 64))
    ] = (1, 2, 3)
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


class SerialSource:
    """Reads what the line holds, without ever waiting for it."""

    def __init__(self, parameters: SerialParameters) -> None:
        """Start with a closed line; `read` opens it and keeps trying."""
        self._given = parameters
        self._line: serial.Serial | None = None
        self._buffer = b''
        self._problems: list[str] = []
        self._told: set[str] = set()
        self._attempts = _Attempts()
        self._hearing = _Hearing(parameters)

    @property
    def period(self) -> float:
        """Usual time between samples [s]."""
        return self._given.period

    def history(self, now: float) -> Iterable[ProbeSample]:  # noqa: ARG002 - a line has no past
        """Return nothing: a serial line remembers nothing; use the node's state file."""
        return ()

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples of all whole lines that have come, whatever their time."""
        self._hearing.note(self._fill(), now)
        *lines, self._buffer = re.split(rb'[\r\n]', self._buffer)
        if len(self._buffer) > LONGEST_LINE:
            self._note(f'{len(self._buffer)} bytes without a line end were dropped')
            self._buffer = b''
        samples = []
        for line in lines:
            text = cleaned(line)
            if text:
                self._hearing.last = text
                try:
                    read = _read(text, self._given, now)
                    samples.append(_sample(text, read, self._given))
                except SignalError as error:
                    self._note(str(error))
                else:
                    self._tell_oddities(text, read, now)
        if self._line is not None and (silence := self._hearing.silence(now)):
            self._note(silence)
        return samples

    def _tell_oddities(self, text: str, line: LoggerLine, now: float) -> None:
        """Tell once of decimal commas, and of a clock that is off by days."""
        if line.decimal_comma and 'comma' not in self._told:
            self._told.add('comma')
            self._note(f"decimal commas in '{text:.80}' are read as points: told once")
        off = line.time - now
        if abs(off) < OFF_CLOCK or now < EPOCHS[0]:  # a clock that has not begun tells nothing
            self._told.discard('clock')
        elif 'clock' not in self._told:
            self._told.add('clock')
            self._note(
                f"the time of '{text:.80}' is {abs(off) / OFF_CLOCK:.0f} days "
                f'{"ahead of" if off > 0.0 else "behind"} the clock here: set the logger, day '
                'before month; night and day are learnt by its time'
            )

    def complaint(self) -> str:
        """Return what was unreadable or missing, the first few things of it."""
        problems, self._problems = self._problems, []
        left = len(problems) - MOST_TOLD
        return '; '.join(problems[:MOST_TOLD]) + (f'; and {left} more' if left > 0 else '')

    def close(self) -> None:
        """Close the line."""
        if self._line is not None:
            self._line.close()
            self._line = None

    def _note(self, problem: str) -> None:
        self._problems.append(problem)

    def _fill(self) -> int:
        """Read what is there, and return how much; open the line if it is not, with pauses."""
        try:
            if self._line is None:
                if not self._attempts.due():
                    return 0
                self._line = serial.Serial(self._given.port, self._given.baud, timeout=0)
                self._buffer = b''
                self._attempts = _Attempts()
            data: bytes = self._line.read(65536)
        except (OSError, serial.SerialException) as error:
            self.close()
            self._note(
                f'{self._given.port} is not readable ({error}): check cable and permissions; '
                f'trying again in {self._attempts.fail():.0f} s'
            )
            return 0
        self._buffer += data
        return len(data)


class _Attempts:
    """When to try again to open a line that is gone: after pauses that grow."""

    def __init__(self) -> None:
        self._pause, self._at = 1.0, 0.0

    def due(self) -> bool:
        return wall.monotonic() >= self._at

    def fail(self) -> float:
        """Return after how long to try again [s]."""
        pause, self._pause = self._pause, min(2.0 * self._pause, LONGEST_PAUSE)
        self._at = wall.monotonic() + pause
        return pause


class _Hearing:
    """When something last came over the line, and what."""

    def __init__(self, given: SerialParameters) -> None:
        self._given = given
        self._at: float | None = None
        self._told = False
        self.last = ''

    def note(self, count: int, now: float) -> None:
        """Note that ``count`` bytes came."""
        if count or self._at is None or now < self._at:
            self._at, self._told = now, False

    def silence(self, now: float) -> str:
        """Return once that nothing has come for long, and what came last."""
        silent = now - (now if self._at is None else self._at)
        if self._told or silent <= SILENT * self._given.period:
            return ''
        self._told = True
        if self.last:
            return f"nothing has come for {silent:.0f} s; the last was '{self.last:.80}'"
        return (
            f'nothing has come from {self._given.port} in {silent:.0f} s at {self._given.baud} '
            'baud: look whether the logger is on, and at the cable'
        )


def parse_line(text: str, parameters: SerialParameters, now: float = 0.0) -> ProbeSample:
    """Return the sample of one line that arrives ``now`` [s]; a field that is no number is NaN.

    Raises:
        SignalError: The line has no one reading, or a field is missing; the line is quoted.

    """
    return _sample(text, _read(text, parameters, now), parameters)


def _read(text: str, given: SerialParameters, now: float) -> LoggerLine:
    try:
        line = checked(text, Checksum(given.checksum))
        return line_reader(given.format, given.time_format)(line, Arrival(now, given.utc_offset))
    except SignalError as error:
        garbage = sum(not ' ' <= letter <= '~' for letter in text) > GARBAGE * len(text)
        why = f'it is no text: {given.baud} baud may not be its speed' if garbage else error
        msg = f"unreadable line '{text:.80}': {why}"
        raise SignalError(msg) from error


def _sample(text: str, line: LoggerLine, parameters: SerialParameters) -> ProbeSample:
    if len(line.values) < max(parameters.fields):
        msg = (
            f"line '{text:.80}' has {len(line.values)} values, probe field "
            f'{max(parameters.fields)} is missing: check the logger, or the parameter serial.fields'
        )
        raise SignalError(msg)
    factor = kelvin_per(parameters.unit, parameters.kelvin_per_millivolt)
    return ProbeSample(
        line.time, tuple(kelvin(line.values[f - 1], factor) for f in parameters.fields)
    )
