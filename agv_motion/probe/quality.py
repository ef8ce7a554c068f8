"""Whether a reading can be believed, judged from the past alone."""

from __future__ import annotations

from collections import deque
from enum import Enum
from math import isfinite
from statistics import median

from agv_motion.probe.noise import NoiseWatch

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
    """dT near zero or negative: no heating, or disconnected; or back, but not yet standing still"""
    OUT_OF_RANGE = 'out of range'
    SPIKE = 'spike'
    STUCK = 'stuck'
    NOISE = 'noise'
    """its variance is that of noise: off, or a wire that hangs free"""

    @property
    def usable(self) -> bool:
        """Whether a sap flow may be computed from the reading."""
        return self in {Quality.GOOD, Quality.NEGATIVE_FLOW}


class ReadingLevel:
    """The level of recent readings; those that persist elsewhere become the level."""

    def __init__(self, spike_threshold: float, noise_above: float) -> None:
        """Know no level.

        Args:
            spike_threshold: Change against the level, as a share of it, that leaves it.
            noise_above: Distance from the line through its neighbours, as a share, from which on a
                reading is noise.

        """
        self._threshold = spike_threshold
        self.settling = 0.0
        """time that a heater needs once it is on again [s]"""
        self._on_since: float | None = None
        """when readings came back that were off [s]"""
        self._recent: deque[float] = deque(maxlen=RECENT)
        self._suspects: deque[float] = deque(maxlen=STEP)
        self._noise = NoiseWatch(noise_above)
        self._was: Quality | None = None
        """OFF or NOISE, until readings stand still again"""
        self.has_stepped = False
        """whether the last reading made another level the one that is believed"""

    def forget(self) -> None:
        """Take the next readings for the level."""
        self._recent.clear()
        self._noise.clear()

    def go_off(self) -> None:
        """Forget the level; what comes next must stand still before it is believed."""
        self.forget()
        self._was, self._on_since = Quality.OFF, None

    @property
    def noise_since(self) -> float:
        """When the readings began that are noise, if the last is [s]."""
        return self._noise.since

    def judge(self, time: float, value: float) -> Quality:
        """Return whether ``value`` [K] at ``time`` [s] is a spike, noise, still off, or good."""
        if self._on_since is None:
            self._on_since = time
        if self._noise.add(time, value):
            self._was = Quality.NOISE
        elif self._noise.is_quiet() and abs(time - self._on_since) >= self.settling:
            self._was = None
        quality = self._compared(value)
        return self._was or quality if quality is Quality.GOOD else quality

    def _compared(self, value: float) -> Quality:
        if len(self._recent) < RECENT or self._alike(value, median(self._recent)):
            self._suspects.clear()
            self._recent.append(value)
            return Quality.GOOD
        self._suspects.append(value)
        if len(self._suspects) == STEP and self._alike(value, median(self._suspects)):
            self._recent.clear()
            self._recent.extend(self._suspects)
            self._suspects.clear()
            self.has_stepped = True
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
        noise_above: float = 0.015,
    ) -> None:
        """Start without a past.

        Args:
            off_below: dT below which the probe counts as off [K].
            highest: dT above which nothing is believed [K].
            spike_threshold: Change against the recent median that makes a spike, as a share [-].
            stuck_after: How long the very same value may last while sap flows, and at rest, when
                a coarse logger legitimately repeats itself [s].
            noise_above: Distance from the line through its neighbours, as a share, from which on a
                reading is noise.

        """
        self._off_below, self._highest = off_below, highest
        self._stuck_after = stuck_after
        self.level = ReadingLevel(spike_threshold, noise_above)
        self._last_time = -FORGET
        self._same_value, self._same_since = 0.0, 0.0

    def judge(self, time: float, value: float, *, flowing: bool) -> Quality:
        """Return the quality of ``value`` [K] read at ``time`` [s].

        Args:
            time: Of the reading.
            value: dT; NaN where there is none.
            flowing: Whether sap was flowing at the last reading.

        """
        self.level.has_stepped = False
        if not isfinite(value):
            return Quality.MISSING
        if value < self._off_below:
            self.level.go_off()
            return Quality.OFF
        if value > self._highest:
            return Quality.OUT_OF_RANGE
        if not 0.0 <= time - self._last_time < FORGET:
            self.level.forget()
            self._same_since = time
        self._last_time = time
        if value != self._same_value:
            self._same_value, self._same_since = value, time
        if time - self._same_since >= self._stuck_after[0 if flowing else 1]:
            return Quality.STUCK
        return self.level.judge(time, value)
