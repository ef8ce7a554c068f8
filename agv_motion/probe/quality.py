"""Whether a reading can be believed, judged from the past alone."""

from __future__ import annotations

from collections import deque
from enum import Enum
from math import isfinite
from statistics import median

RECENT = 5
"""Number of good readings whose median a new one is compared with (a causal Hampel filter)."""

STEP = 3
"""Number of readings in a row, alike among themselves, that make a spike the new level."""

FORGET = 6 * 3600.0
"""[s] After such a gap the readings before it say nothing about the next."""


class Quality(Enum):
    """What is wrong with a reading, if anything."""

    GOOD = 'good'
    NEGATIVE_FLOW = 'negative flow'
    """dT above dT_max: the zero-flow value is out of date; counts as no flow"""
    MISSING = 'missing'
    OFF = 'off'
    """dT near zero or negative: no heating, or disconnected"""
    OUT_OF_RANGE = 'out of range'
    SPIKE = 'spike'
    STUCK = 'stuck'

    @property
    def usable(self) -> bool:
        """Whether a sap flow may be computed from the reading."""
        return self in {Quality.GOOD, Quality.NEGATIVE_FLOW}


class ReadingLevel:
    """The level of recent readings; those that persist elsewhere become the level."""

    def __init__(self, spike_threshold: float) -> None:
        """Know no level; a change by more than ``spike_threshold``, a share of it, leaves it."""
        self._threshold = spike_threshold
        self._recent: deque[float] = deque(maxlen=RECENT)
        self._suspects: deque[float] = deque(maxlen=STEP)

    def forget(self) -> None:
        """Take the next readings for the level."""
        self._recent.clear()

    def judge(self, value: float) -> Quality:
        """Return whether ``value`` is a spike, or good."""
        if len(self._recent) < RECENT or self._alike(value, median(self._recent)):
            self._suspects.clear()
            self._recent.append(value)
            return Quality.GOOD
        self._suspects.append(value)
        if len(self._suspects) == STEP and self._alike(value, median(self._suspects)):
            self._recent.clear()
            self._recent.extend(self._suspects)
            self._suspects.clear()
            return Quality.GOOD
        return Quality.SPIKE

    def _alike(self, value: float, level: float) -> bool:
        return abs(value - level) <= self._threshold * level


class ReadingJudge:
    """Judges readings of one probe one after another."""

    def __init__(
        self,
        off_below: float,
        highest: float,
        spike_threshold: float,
        stuck_after: tuple[float, float],
    ) -> None:
        """Start without a past.

        Args:
            off_below: dT below which the probe counts as off [K].
            highest: dT above which nothing is believed [K].
            spike_threshold: Change against the recent median that makes a spike, as a share [-].
            stuck_after: How long the very same value may last while sap flows, and at rest, when
                a coarse logger legitimately repeats itself [s].

        """
        self._off_below, self._highest = off_below, highest
        self._stuck_after = stuck_after
        self._level = ReadingLevel(spike_threshold)
        self._last_time = -FORGET
        self._same_value, self._same_since = 0.0, 0.0

    def judge(self, time: float, value: float, *, flowing: bool) -> Quality:
        """Return the quality of ``value`` [K] read at ``time`` [s].

        Args:
            time: Of the reading.
            value: dT; NaN where there is none.
            flowing: Whether sap was flowing at the last reading.

        """
        if not isfinite(value):
            return Quality.MISSING
        if value < self._off_below:
            self._level.forget()
            return Quality.OFF
        if value > self._highest:
            return Quality.OUT_OF_RANGE
        if not 0.0 <= time - self._last_time < FORGET:
            self._level.forget()
            self._same_since = time
        self._last_time = time
        if value != self._same_value:
            self._same_value, self._same_since = value, time
        if time - self._same_since >= self._stuck_after[0 if flowing else 1]:
            return Quality.STUCK
        return self._level.judge(value)
