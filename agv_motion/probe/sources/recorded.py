"""Readings that were recorded before, in place of the source that gave them."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan
from typing import TYPE_CHECKING

from agv_motion.probe.environment import UNKNOWN, Environment
from agv_motion.probe.sources.source import ProbeSample

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.probe.sources.source import ProbeSource

PATIENCE = 0.5
"""[s] after which a sample counts as whole though not every probe has told its reading"""


@dataclass
class _Row:
    """What belongs to one sample, as far as it has been told."""

    values: list[float]
    """[K] NaN where a probe has said nothing"""
    environment: Environment | None = None
    time: float | None = None
    """[s] by the clock of the logger"""

    def is_empty(self) -> bool:
        return all(map(isnan, self.values))

    def is_whole(self) -> bool:
        return not any(map(isnan, self.values))


class RecordedSource:
    """Puts the readings of single probes, told one by one, together again.

    Those of one sample have one stamp, that of the node that told them. Several samples may have
    the same, where a file was played fast: then what comes twice is of the next one.
    """

    def __init__(self, live: ProbeSource, probes: int) -> None:
        """Start without a reading.

        Args:
            live: The source that gave the readings; it is asked for its history alone.
            probes: Number of probes.

        """
        self.period = live.period
        self._live = live
        self._probes = probes
        self._waiting: dict[float, list[_Row]] = {}

    def take(self, probe: int, stamp: float, value: float) -> None:
        """Note a reading.

        Args:
            probe: Which one, from 0.
            stamp: When the node told it [s].
            value: Temperature difference [K].

        """
        row = self._row(stamp)
        if not isnan(row.values[probe]):
            row = self._next(stamp)
        row.values[probe] = value

    def take_time(self, stamp: float, time: float) -> None:
        """Note when the logger read [s] what is told at ``stamp`` after it."""
        row = self._row(stamp)
        if row.time is not None or not row.is_empty():
            row = self._next(stamp)
        row.time = time

    def take_environment(self, stamp: float, environment: Environment) -> None:
        """Note the air of what is told at ``stamp`` [s] after it."""
        row = self._row(stamp)
        if row.environment is not None or not row.is_empty():
            row = self._next(stamp)
        row.environment = environment

    def history(self, now: float) -> Iterable[ProbeSample]:
        """Return what the live source knew before ``now`` [s]."""
        return self._live.history(now)

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples that are whole, as of the time of their logger where that was told."""
        whole = [
            stamp
            for stamp, rows in self._waiting.items()
            if now - stamp > PATIENCE or rows[-1].is_whole()
        ]
        return [
            ProbeSample(
                stamp if row.time is None else row.time,
                tuple(row.values),
                row.environment or UNKNOWN,
            )
            for stamp in sorted(whole)
            for row in self._waiting.pop(stamp)
        ]

    def complaint(self) -> str:
        """Return nothing: what went wrong is in the recording."""
        return ''

    def close(self) -> None:
        """Let go of the live source."""
        self._live.close()

    def _row(self, stamp: float) -> _Row:
        """Return the row of a stamp to which something came last."""
        rows = self._waiting.get(stamp)
        return rows[-1] if rows else self._next(stamp)

    def _next(self, stamp: float) -> _Row:
        row = _Row([float('nan')] * self._probes)
        self._waiting.setdefault(stamp, []).append(row)
        return row
