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
from agv_motion.probe.sources.logger_line import EPOCHS, LoggerLine, cleaned, read_line
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

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class SerialSource:
    """Reads what the line holds, without ever waiting for it."""

    def __init__(self, parameters: SerialParameters) -> None:
        """Start with a closed line; `read` opens it and keeps trying."""
        self._given = parameters
        self._line: serial.Serial | None = None
        self._buffer = b''
        self._problems: list[str] = []
        self._told: set[str] = set()
        self._pause, self._retry_at = 1.0, 0.0

    @property
    def period(self) -> float:
        """Usual time between samples [s]."""
        return self._given.period

    def history(self, now: float) -> Iterable[ProbeSample]:  # noqa: ARG002 - a line has no past
        """Return nothing: a serial line remembers nothing; use the node's state file."""
        return ()

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples of all whole lines that have come, whatever their time."""
        self._fill()
        *lines, self._buffer = re.split(rb'[\r\n]', self._buffer)
        if len(self._buffer) > LONGEST_LINE:
            self._note(f'{len(self._buffer)} bytes without a line end were dropped')
            self._buffer = b''
        samples = []
        for line in lines:
            text = cleaned(line)
            if text:
                try:
                    read = _read(text, self._given)
                    samples.append(_sample(text, read, self._given))
                except SignalError as error:
                    self._note(str(error))
                else:
                    self._tell_oddities(text, read, now)
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

    def _fill(self) -> None:
        """Read what is there; open the line if it is not, with growing pauses."""
        try:
            if self._line is None:
                if wall.monotonic() < self._retry_at:
                    return
                self._line = serial.Serial(self._given.port, self._given.baud, timeout=0)
                self._buffer, self._pause = b'', 1.0
            self._buffer += self._line.read(65536)
        except (OSError, serial.SerialException) as error:
            self.close()
            self._retry_at = wall.monotonic() + self._pause
            self._note(
                f'{self._given.port} is not readable ({error}): check cable and permissions; '
                f'trying again in {self._pause:.0f} s'
            )
            self._pause = min(2.0 * self._pause, LONGEST_PAUSE)


def parse_line(text: str, parameters: SerialParameters) -> ProbeSample:
    """Return the sample of one line; a field that is no number is NaN.

    Raises:
        SignalError: The line has no one reading, or a field is missing; the line is quoted.

    """
    return _sample(text, _read(text, parameters), parameters)


def _read(text: str, parameters: SerialParameters) -> LoggerLine:
    try:
        return read_line(text, parameters.utc_offset)
    except SignalError as error:
        msg = f"unreadable line '{text:.80}': {error}"
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
