"""Readings that were recorded before, in place of the source that gave them."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from agv_motion.probe.environment import UNKNOWN, Environment
from agv_motion.probe.sources.source import ProbeSample

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.probe.sources.source import ProbeSource

PATIENCE = 0.5
"""[s] after which a sample counts as whole though not every probe has told its reading"""


class RecordedSource:
    """Puts the readings of single probes, told one by one, together again."""

    def __init__(self, live: ProbeSource, probes: int) -> None:
        """Start without a reading.

        Args:
            live: The source that gave the readings; it is asked for its history alone.
            probes: Number of probes.

        """
        self.period = live.period
        self._live = live
        self._probes = probes
        self._waiting: dict[float, list[float]] = {}
        self._air: dict[float, Environment] = {}

    def take(self, probe: int, time: float, value: float) -> None:
        """Note a reading.

        Args:
            probe: Which one, from 0.
            time: When it was read [s].
            value: Temperature difference [K].

        """
        self._waiting.setdefault(time, [nan] * self._probes)[probe] = value

    def take_environment(self, time: float, environment: Environment) -> None:
        """Note the air at ``time`` [s], which is told before the readings of that time."""
        self._air[time] = environment

    def history(self, now: float) -> Iterable[ProbeSample]:
        """Return what the live source knew before ``now`` [s]."""
        return self._live.history(now)

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples that are whole."""
        whole = [
            time
            for time, values in self._waiting.items()
            if now - time > PATIENCE or not any(value != value for value in values)  # noqa: PLR0124
        ]
        return [
            ProbeSample(time, tuple(self._waiting.pop(time)), self._air.pop(time, UNKNOWN))
            for time in sorted(whole)
        ]

    def complaint(self) -> str:
        """Return nothing: what went wrong is in the recording."""
        return ''

    def close(self) -> None:
        """Let go of the live source."""
        self._live.close()
