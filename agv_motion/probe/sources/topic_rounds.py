"""Probes that each have a topic of their own, brought together into lines of all of them."""

from __future__ import annotations

from math import nan

from agv_motion.probe.sources.logger_line import LoggerLine


class TopicRounds:
    """Values that belong together: of one time, each probe once."""

    def __init__(self, probes: int, within: float) -> None:
        """Have no value yet.

        Args:
            probes: How many make a round.
            within: By how much their times may differ [s], and how long to wait for the last.

        """
        self._probes, self._within = probes, within
        self._values: dict[int, float] = {}
        self._time = self._began = 0.0

    def add(self, probe: int, time: float, value: float, now: float) -> list[LoggerLine]:
        """Take the value of a probe [s since 1970, unit of the logger]; return what is whole.

        A round that another one overtakes is told as it is, NaN where a probe said nothing.
        """
        done = []
        if self._values and (probe in self._values or abs(time - self._time) > self._within):
            done.append(self._line())
        if not self._values:
            self._time, self._began = time, now
        self._values[probe] = value
        self._time = max(self._time, time)
        if len(self._values) == self._probes:
            done.append(self._line())
        return done

    def overdue(self, now: float) -> list[LoggerLine]:
        """Return the round whose last probes have not come in time."""
        waited = abs(now - self._began)
        return [self._line()] if self._values and waited > self._within else []

    def _line(self) -> LoggerLine:
        values = tuple(self._values.get(probe, nan) for probe in range(self._probes))
        self._values = {}
        return LoggerLine(self._time, values, decimal_comma=False)
