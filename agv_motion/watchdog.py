"""Silence of an input: noticed, told, and then a reason to stop."""

from __future__ import annotations

from enum import Enum

from agv_motion.errors import ConfigurationError


class Silence(Enum):
    """How long an input has been silent, in steps of what to do about it."""

    FRESH = 'fresh'
    LATE = 'late'
    """Worth a report; the robot goes on."""
    LOST = 'lost'
    """The robot must stop."""


FRESH = Silence.FRESH
"""Looked up once: in Python 3.11 a member of an Enum costs as much as ten multiplications."""


class Watchdog:
    """Judges the age of the last input.

    The original installation reported after 3 s and stopped after 5 s.

    All times are of one clock that never leaps: a clock that is set must not switch a guard off.
    """

    def __init__(self, report_after: float, stop_after: float) -> None:
        """Start with an input that has never come.

        Args:
            report_after: Age from which the input is late [s].
            stop_after: Age from which it is lost [s].

        Raises:
            ConfigurationError: The two are not positive and in order.

        """
        if not 0.0 < report_after <= stop_after:
            msg = (
                f'report_after = {report_after} s, stop_after = {stop_after} s: '
                'both must be positive and the report must not come after the stop'
            )
            raise ConfigurationError(msg)
        self._report_after = report_after
        self.stop_after = stop_after
        self._last: float | None = None

    def feed(self, now: float) -> None:
        """Note that an input has come at ``now`` [s]."""
        self._last = now

    def forget(self) -> None:
        """Take the input for lost until it comes again."""
        self._last = None

    def age(self, now: float) -> float | None:
        """Return the age of the last input [s], or None if none has come."""
        return None if self._last is None else now - self._last

    def judge(self, now: float) -> Silence:
        """Return how silent the input is at ``now`` [s]."""
        if self._last is None:
            return Silence.LOST
        age = now - self._last
        if age < self._report_after:
            return FRESH
        return Silence.LOST if age >= self.stop_after else Silence.LATE
