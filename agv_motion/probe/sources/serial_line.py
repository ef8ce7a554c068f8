"""Probes on a serial line: ``DD-MM-YY HH:MM:SS v1 v2 v3 ...``, one line a reading.

A line that cannot be read is counted and told, a line that goes away is opened again.
"""

from __future__ import annotations

import time as wall
from dataclasses import dataclass
from datetime import datetime, timedelta, timezone
from math import isfinite, nan
from typing import TYPE_CHECKING, Annotated

import serial

from agv_motion.errors import SignalError
from agv_motion.parameters import Spec, check
from agv_motion.probe.sources.source import KELVIN_PER_MILLIVOLT, UNITS, Sample, kelvin_per

if TYPE_CHECKING:
    from collections.abc import Iterable

LONGEST_LINE = 1024
"""[bytes] Anything longer without a line end is rubbish and dropped."""

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
        self.period = parameters.period
        self._line: serial.Serial | None = None
        self._buffer = b''
        self._problem = ''
        self._pause, self._retry_at = 1.0, 0.0

    def history(self, now: float) -> Iterable[Sample]:  # noqa: ARG002 - a line has no past
        """Return nothing: a serial line remembers nothing; use the node's state file."""
        return ()

    def read(self, now: float) -> list[Sample]:  # noqa: ARG002 - whatever has come is due
        """Return the samples of all whole lines that have come."""
        self._fill()
        *lines, self._buffer = self._buffer.split(b'\n')
        if len(self._buffer) > LONGEST_LINE:
            self._problem = f'{len(self._buffer)} bytes without a line end were dropped'
            self._buffer = b''
        samples = []
        for line in lines:
            text = line.decode('ascii', errors='replace').strip()
            if text:
                try:
                    samples.append(parse_line(text, self._given))
                except SignalError as error:
                    self._problem = str(error)
        return samples

    def complaint(self) -> str:
        """Return the last thing that was unreadable or missing."""
        problem, self._problem = self._problem, ''
        return problem

    def close(self) -> None:
        """Close the line."""
        if self._line is not None:
            self._line.close()
            self._line = None

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
            self._problem = (
                f'{self._given.port} is not readable ({error}): check cable and permissions; '
                f'trying again in {self._pause:.0f} s'
            )
            self._pause = min(2.0 * self._pause, LONGEST_PAUSE)


def parse_line(text: str, parameters: SerialParameters) -> Sample:
    """Return the sample of one line; a field that is no number is NaN.

    Raises:
        SignalError: The time is unreadable or a field is missing; the line is quoted.

    """
    words = text.split()
    try:
        moment = datetime.strptime(' '.join(words[:2]), '%d-%m-%y %H:%M:%S')  # noqa: DTZ007
    except ValueError as error:
        msg = f"unreadable line '{text:.80}': expected DD-MM-YY HH:MM:SS v1 v2 ..."
        raise SignalError(msg) from error
    values = words[2:]
    if len(values) < max(parameters.fields):
        msg = (
            f"line '{text:.80}' has {len(values)} values, probe field {max(parameters.fields)} "
            'is missing: check the logger, or the parameter serial.fields'
        )
        raise SignalError(msg)
    utc = moment.replace(tzinfo=timezone.utc) - timedelta(hours=parameters.utc_offset)
    factor = kelvin_per(parameters.unit, parameters.kelvin_per_millivolt)
    return Sample(
        utc.timestamp(), tuple(factor * _number(values[field - 1]) for field in parameters.fields)
    )


def _number(word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        return nan
    return number if isfinite(number) else nan
