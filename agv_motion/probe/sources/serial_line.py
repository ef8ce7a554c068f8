"""Probes on a serial line: ``DD-MM-YY HH:MM:SS v1 v2 v3 ...``, one line a reading.

What else loggers write is in :mod:`line_formats`. A line that cannot be read is told, a line that
goes away is opened again.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import serial

from agv_motion.parameters import Spec
from agv_motion.probe.sources.attempts import Attempts
from agv_motion.probe.sources.line_listener import Origin
from agv_motion.probe.sources.line_reading import LineParameters, LineReader
from agv_motion.probe.sources.logger_clock import LoggerClock
from agv_motion.probe.sources.logger_line import LONGEST_LINE, cleaned

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.probe.sources.source import ProbeSample


@dataclass(frozen=True)
class SerialParameters(LineParameters):
    """The line and what stands in it."""

    port: Annotated[str, Spec('device of the logger')] = '/dev/ttyUSB0'
    baud: Annotated[int, Spec('speed of the line', 'baud', (300, 4_000_000))] = 38400


class SerialSource:
    """Reads what the line holds, without ever waiting for it."""

    def __init__(self, parameters: SerialParameters) -> None:
        """Start with a closed line; `read` opens it and keeps trying."""
        self._given = given = parameters
        self._line: serial.Serial | None = None
        self._buffer = b''
        self._attempts = Attempts()
        self._clock = LoggerClock()
        self._reader = LineReader(
            given,
            Origin(
                f'from {given.port} at {given.baud} baud',
                'look whether the logger is on, and at the cable',
                f'{given.baud} baud may not be its speed',
            ),
        )

    @property
    def period(self) -> float:
        """Usual time between samples [s]."""
        return self._given.period

    def history(self, now: float) -> Iterable[ProbeSample]:  # noqa: ARG002 - a line has no past
        """Return nothing: a serial line remembers nothing; use the node's state file."""
        return ()

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples of all whole lines that have come, whatever their time."""
        self._reader.heard(now, something=self._fill() > 0)
        *lines, self._buffer = re.split(rb'[\r\n]', self._buffer)
        if len(self._buffer) > LONGEST_LINE:
            self._reader.note(f'{len(self._buffer)} bytes without a line end were dropped')
            self._buffer = b''
        samples = [
            sample
            for line in lines
            if (text := cleaned(line)) and (sample := self._sample(text, now)) is not None
        ]
        if self._line is not None:
            self._reader.listen(now)
        return samples

    def _sample(self, text: str, now: float) -> ProbeSample | None:
        line = self._reader.line(text, now)
        if line is None:
            return None
        if self._clock.has_leapt(line.time, now):
            self._reader.note(
                f"the time of '{text:.80}' does not go on from the lines before, by days: left "
                'out, unless the next one goes on from it'
            )
            return None
        sample = self._reader.sample(text, line)
        if sample is not None:
            self._reader.doubt_clock(text, line, now)
        return sample

    def complaint(self) -> str:
        """Return what was unreadable or missing, the first few things of it."""
        return self._reader.complaint()

    def close(self) -> None:
        """Close the line."""
        if self._line is not None:
            self._line.close()
            self._line = None

    def _fill(self) -> int:
        """Read what is there, and return how much; open the line if it is not, with pauses."""
        try:
            if self._line is None:
                if not self._attempts.due():
                    return 0
                self._line = serial.Serial(self._given.port, self._given.baud, timeout=0)
                self._buffer = b''
                self._attempts = Attempts()
            data: bytes = self._line.read(65536)
        except (OSError, serial.SerialException) as error:
            self.close()
            self._reader.note(
                f'{self._given.port} is not readable ({error}): check cable and permissions; '
                f'trying again in {self._attempts.fail():.0f} s'
            )
            return 0
        self._buffer += data
        return len(data)
