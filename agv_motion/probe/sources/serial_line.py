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
from agv_motion.parameters import Spec
from agv_motion.probe.sources.line_reading import LineParameters, read_line_of, sample_of
from agv_motion.probe.sources.logger_line import EPOCHS, LoggerLine, cleaned

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.probe.sources.source import ProbeSample

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
class SerialParameters(LineParameters):
    """The line and what stands in it."""

    port: Annotated[str, Spec('device of the logger')] = '/dev/ttyUSB0'
    baud: Annotated[int, Spec('speed of the line', 'baud', (300, 4_000_000))] = 38400


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
                    read = read_line_of(text, self._given, now)
                    samples.append(sample_of(text, read, self._given))
                except SignalError as error:
                    self._note(str(error) if is_text(text) else self._no_text(text))
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

    def _no_text(self, text: str) -> str:
        baud = self._given.baud
        return f"unreadable line '{text:.80}': it is no text: {baud} baud may not be its speed"

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


def is_text(line: str) -> bool:
    """Tell whether a line may be text that was sent at the speed at which it was read."""
    return sum(not ' ' <= letter <= '~' for letter in line) <= GARBAGE * len(line)


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
