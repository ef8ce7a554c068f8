"""What is to be told of a logger and its lines: garbage, oddities, silence."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.probe.sources.logger_clock import OFF_CLOCK
from agv_motion.probe.sources.logger_line import EPOCHS

if TYPE_CHECKING:
    from agv_motion.probe.sources.logger_line import LoggerLine

MOST_TOLD = 3
"""Problems in one complaint; the others are counted."""

SILENT = 3.0
"""Usual times between lines after which silence is told."""

GARBAGE = 0.3
"""Share of a line that is no letter, from which on it is no text."""


class Origin(NamedTuple):
    """Where lines come from, in words."""

    place: str
    """such as: from /dev/ttyUSB0 at 38400 baud"""
    silence: str
    """what to look at where nothing ever came"""
    garbage: str
    """why what comes may be no text"""


class LineListener:
    """Keeps what is wrong with lines until it is asked."""

    def __init__(self, period: float, origin: Origin) -> None:
        """Have heard nothing; a line usually comes each ``period`` [s]."""
        self._period, self._origin = period, origin
        self._problems: list[str] = []
        self._told: set[str] = set()
        self._at: float | None = None
        self.last = ''

    def heard(self, now: float, *, something: bool) -> None:
        """Note whether something came; silence counts from the first call."""
        if something or self._at is None or now < self._at:
            self._at = now
            self._told.discard('silence')

    def unreadable(self, text: str, reason: str) -> None:
        """Keep why a line cannot be read, or that it is no text."""
        garbage = f"unreadable line '{text:.80}': it is no text: {self._origin.garbage}"
        self.note(reason if is_text(text) else garbage)

    def doubt_clock(self, text: str, line: LoggerLine, now: float) -> None:
        """Tell once of a logger whose clock is off by days."""
        off = line.time - now
        if abs(off) < OFF_CLOCK or now < EPOCHS[0]:  # a clock that has not begun tells nothing
            self._told.discard('clock')
            return
        self.note_once(
            'clock',
            f"the time of '{text:.80}' is {abs(off) / OFF_CLOCK:.0f} days "
            f'{"ahead of" if off > 0.0 else "behind"} the clock here: set the logger, day '
            'before month; night and day are learnt by its time',
        )

    def listen(self, now: float) -> None:
        """Tell once that nothing has come for long, and what came last."""
        silent = now - (now if self._at is None else self._at)
        if silent <= SILENT * self._period:
            return
        place, look = self._origin.place, self._origin.silence
        self.note_once(
            'silence',
            f"nothing has come for {silent:.0f} s; the last was '{self.last:.80}'"
            if self.last
            else f'nothing has come in {silent:.0f} s {place}: {look}',
        )

    def note(self, problem: str) -> None:
        """Keep a problem."""
        self._problems.append(problem)

    def note_once(self, kind: str, problem: str) -> None:
        """Keep a problem, unless one of its kind was told before."""
        if kind not in self._told:
            self._told.add(kind)
            self.note(problem)

    def complaint(self) -> str:
        """Return what was unreadable or missing, the first few things of it."""
        problems, self._problems = self._problems, []
        left = len(problems) - MOST_TOLD
        return '; '.join(problems[:MOST_TOLD]) + (f'; and {left} more' if left > 0 else '')


def is_text(line: str) -> bool:
    """Tell whether a line may be text."""
    return sum(not ' ' <= letter <= '~' for letter in line) <= GARBAGE * len(line)
